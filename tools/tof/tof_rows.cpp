// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/tof_rows.hpp"

#include <charconv>
#include <cmath>

#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

// What follows the columns of the contract.
const std::vector<std::string> kDetails = {"frames",      "seen",         "outer_radius_m",       "inner_radius_m",
                                           "edge_rms_px", "plane_rms_mm", "connector_distance_m", "connector_height_m"};
const std::vector<std::string> kSecond = {"alt_qw",   "alt_qx",   "alt_qy",   "alt_qz",
                                          "alt_tx_m", "alt_ty_m", "alt_tz_m", "delta_chi2"};

void write_quaternion(host::RowWriter& rows, const Matrix3& R) {
  const Quaternion q = canonical_quaternion(R);
  rows.number(q.w()).number(q.x()).number(q.y()).number(q.z());
}

// The frame's number; of so many digits, nanoseconds since 1970.
double frame_time_s(const std::string& frame) {
  constexpr std::size_t kStampDigits = 16;
  constexpr double kNanosecond_s = 1e-9;
  std::uint64_t number = 0;
  std::from_chars(frame.data(), frame.data() + frame.size(), number);
  return static_cast<double>(number) * (frame.size() >= kStampDigits ? kNanosecond_s : 1.0);
}

host::RowPose row_pose(const std::string& frame, const tof::TargetPose& target, bool has_turn, bool ambiguous) {
  const host::PoseGrade grade = !has_turn   ? host::PoseGrade::kNoTurn
                                : ambiguous ? host::PoseGrade::kAmbiguous
                                            : host::PoseGrade::kGood;
  return {frame_time_s(frame), canonical_quaternion(target.pose.R), target.pose.t, target.covariance, grade};
}

// Without the turn about Z', gamma and the quaternion have no value, and sigma_rot_deg is that of the two tilts.
void write_target(host::RowWriter& rows, const tof::TargetPose& target, bool has_turn) {
  const PoseNumbers numbers = numbers_of(target.pose);
  const Vector3& t = target.pose.t;
  rows.number(t.x()).number(t.y()).number(t.z()).number(numbers[3]).number(numbers[4]);
  Matrix3 rotation = target.covariance.topLeftCorner<3, 3>();
  if (has_turn) {
    rows.number(numbers[5]);
    write_quaternion(rows, target.pose.R);
  } else {
    rows.none(5);
    const Vector3 normal = target.pose.R.col(2);
    rotation -= normal.dot(rotation * normal) * normal * normal.transpose();
  }
  rows.number(std::sqrt(rotation.trace()) * kDegPerRad);
  rows.number(std::sqrt(target.covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM);
}

}  // namespace

std::vector<std::string> tof_columns() {
  std::vector<std::string> columns = {"frame",    "tx_m",          "ty_m",         "tz_m",   "alpha_deg",
                                      "beta_deg", "gamma_deg",     "qw",           "qx",     "qy",
                                      "qz",       "sigma_rot_deg", "sigma_pos_mm", "status", "flags"};
  columns.insert(columns.end(), kDetails.begin(), kDetails.end());
  columns.insert(columns.end(), kSecond.begin(), kSecond.end());
  return columns;
}

void write_frame(host::RowWriter& rows, const std::string& frame, const tof::TofPose& pose) {
  rows.text(frame);
  write_target(rows, pose.target, pose.has_turn());
  rows.pose(row_pose(frame, pose.target, pose.has_turn(), pose.ambiguous()));
  rows.text(pose.ambiguous() ? "ambiguous" : "ok").text(host::joined_flags(pose.flags, tof::kTofFlagWords));
  const tof::RingFit& ring = pose.ring.fit;
  rows.integer(1).number(ring.seen);
  rows.number(ring.model.radius(tof::RingEdge::kOuter)).number(ring.model.radius(tof::RingEdge::kInner));
  rows.number(ring.edge_rms_px).number(ring.plane_rms_m * kMmPerM);
  if (pose.has_turn()) {
    rows.number(pose.connector.rectangle.centre_m.norm()).number(pose.connector.height_m);
  } else {
    rows.none(2);
  }
  if (pose.second) {
    write_quaternion(rows, pose.second->pose.R);
    const Vector3& t = pose.second->pose.t;
    rows.number(t.x()).number(t.y()).number(t.z()).number(pose.delta_chi2);
  } else {
    rows.none(kSecond.size());
  }
  rows.end_row();
}

void write_paper_frame(host::RowWriter& rows, const std::string& frame, const tof::CameraFromTarget& pose) {
  const PoseNumbers numbers = numbers_of(pose);
  rows.text(frame).number(pose.t.x()).number(pose.t.y()).number(pose.t.z());
  rows.number(numbers[3]).number(numbers[4]).number(numbers[5]);
  write_quaternion(rows, pose.R);
  rows.none(2).text("ok").none();  // sigmas; flags
  rows.pose({frame_time_s(frame), canonical_quaternion(pose.R), pose.t});
  rows.integer(1).none(kDetails.size() - 1 + kSecond.size()).end_row();
}

void write_window(host::RowWriter& rows, const std::string& frame, const WindowMean& window) {
  rows.text(frame);
  write_target(rows, *window.mean(), window.has_turn());
  rows.pose(row_pose(frame, *window.mean(), window.has_turn(), false));
  rows.text("ok").text(host::joined_flags(window.flags(), tof::kTofFlagWords));
  rows.integer(static_cast<std::int64_t>(window.frames()));
  rows.none(kDetails.size() - 1 + kSecond.size()).end_row();
}

void write_refusal(host::RowWriter& rows, const std::string& frame, const std::string& reason) {
  rows.text(frame).none(12).text("refused_" + reason).none(1 + kDetails.size() + kSecond.size()).end_row();
}

std::vector<std::string> summary_columns() {
  return {"statistic", "x_mm", "y_mm", "z_mm", "alpha_deg", "beta_deg", "gamma_deg", "frames"};
}

void write_summary(host::RowWriter& rows, const PoseSummary& summary, SummaryRows which) {
  const auto write = [&](const char* name, const PoseNumbers& numbers) {
    rows.text(name);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (k == 5 && summary.frames_with_turn() == 0) {
        rows.none();
      } else {
        rows.number(numbers[k]);
      }
    }
    rows.integer(static_cast<std::int64_t>(summary.frames())).end_row();
  };
  write("mean", summary.mean());
  write("sigma", summary.deviation());
  if (which == SummaryRows::kAll) write("foretold_sigma", summary.predicted());
}

}  // namespace pharos::tools
