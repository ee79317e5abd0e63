// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/pose_files.hpp"

#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::tools {
namespace {

const std::vector<std::string> kColumns = {"time_s",        "qw",           "qx",    "qy", "qz", "tx_m", "ty_m", "tz_m",
                                           "sigma_rot_deg", "sigma_pos_mm", "status"};

// What is written of a frame's pose.
struct WrittenPose {
  Quaternion q;
  Vector3 t = Vector3::Zero();
  Matrix6 covariance = Matrix6::Zero();
};

WrittenPose written(const slam::TrackedPose& placed, bool of_camera) {
  if (!of_camera) return {canonical_quaternion(placed.pose.R), placed.pose.t, placed.covariance};
  const InversePose inverse = inverse_of(placed);
  return {canonical_quaternion(inverse.pose.R), inverse.pose.t, inverse.covariance};
}

}  // namespace

// R' = exp(a) R, t' = t + b: the inverse turns by -R^T a and moves by -R^T (t x a + b).
InversePose inverse_of(const slam::TrackedPose& placed) {
  const Matrix3 back = placed.pose.R.transpose();
  Matrix6 jacobian = Matrix6::Zero();
  jacobian.topLeftCorner<3, 3>() = -back;
  jacobian.bottomLeftCorner<3, 3>() = -back * skew(placed.pose.t);
  jacobian.bottomRightCorner<3, 3>() = -back;
  return {placed.pose.inverse(), jacobian * placed.covariance * jacobian.transpose()};
}

int write_poses(const PoseFile& file, const std::vector<slam::TrackedFrame>& trajectory) {
  Output output(file.output, kColumns);
  host::RowWriter& rows = output.rows();
  int answers = 0;
  for (const slam::TrackedFrame& frame : trajectory) {
    rows.number(frame.time_s);
    if (!frame.placed) {
      rows.none(kColumns.size() - 2).text("refused_lost").end_row();
      continue;
    }
    const auto [q, t, covariance] = written(*frame.placed, file.of_camera);
    for (const double value : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) rows.number(value);
    rows.number(std::sqrt(covariance.topLeftCorner<3, 3>().trace()) * kDegPerRad);
    rows.number(std::sqrt(covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM);
    rows.pose({frame.time_s, q, t, covariance}).text("ok").end_row();
    ++answers;
  }
  output.finish();
  return answers;
}

}  // namespace pharos::tools
