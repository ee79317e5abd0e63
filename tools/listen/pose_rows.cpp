// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/pose_rows.hpp"

#include <fmt/format.h>

#include <ctime>

#include "host/support/printable.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/tof/target_frame.hpp"
#include "tools/listen/received_state.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
constexpr double kMsPerS = 1e3;
constexpr double kMicrosecond_s = 1e-6;

host::RowPose row_pose(const ReceivedPose& pose) {
  const std::string series = pose.channel + '/' + pose.source + '/' + pose.target + '/' + std::to_string(pose.station);
  return {static_cast<double>(pose.utime_us) * kMicrosecond_s,
          pose.pose->quaternion(),
          pose.pose->t,
          pose.covariance,
          grade_of(pose),
          series};
}

}  // namespace

std::string clock_text(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / kMicrosecondsPerSecond;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:02}:{:02}:{:02}.{:03}", utc.tm_hour, utc.tm_min, utc.tm_sec,
                     utime_us % kMicrosecondsPerSecond / 1000);
}

std::string attitude_text(const ReceivedPose& pose) {
  if (pose.of_camera) {
    const tof::TargetAngles angles = tof::angles_of(pose.pose->R);
    const std::string gamma = pose.has_turn ? fmt::format("{:.2f}", angles.gamma_rad * kDegPerRad) : "-";
    return fmt::format("alpha {:.2f} beta {:.2f} gamma {} deg", angles.alpha_rad * kDegPerRad,
                       angles.beta_rad * kDegPerRad, gamma);
  }
  const Vector3 r_deg = rotation_log(pose.pose->R) * kDegPerRad;
  return fmt::format("r {:.3f} {:.3f} {:.3f} deg", r_deg.x(), r_deg.y(), r_deg.z());
}

std::string pose_line(const ReceivedPose& pose) {
  std::string out = fmt::format("{} {} {} {}", clock_text(pose.utime_us), pose.target,
                                pose.station_id.empty() ? "--------" : pose.station_id, pose.status);
  if (pose.pose) {
    const Vector3 t_mm = pose.pose->t * kMmPerM;
    out += fmt::format("  t {:.2f} {:.2f} {:.2f} mm  ", t_mm.x(), t_mm.y(), t_mm.z()) + attitude_text(pose);
    out += fmt::format("  sigma {:.2f} mm {:.3f} deg  {:.0f}/s", pose.sigma_pos_m * kMmPerM,
                       pose.sigma_rot_rad * kDegPerRad, pose.rate_hz);
  }
  out += fmt::format("  age {:.1f} ms", pose.age_s * kMsPerS);
  if (pose.error) {
    out += fmt::format("  error {:.2f} mm {:.3f} deg", pose.error->position_m * kMmPerM,
                       pose.error->rotation_rad * kDegPerRad);
  }
  if (pose.fused) return host::printable(out + "  " + fused_text(*pose.fused));
  return host::printable(pose.flags.empty() ? out : out + "  " + pose.flags);
}

std::vector<std::string> pose_columns() {
  return {"utime",   "source", "target",    "station", "station_id",    "qw",           "qx",     "qy",
          "qz",      "tx_m",   "ty_m",      "tz_m",    "sigma_rot_deg", "sigma_pos_mm", "status", "flags",
          "rate_hz", "age_ms", "error_deg", "error_mm"};
}

void write_pose_row(host::RowWriter& rows, const ReceivedPose& pose) {
  using host::printable;
  rows.integer(pose.utime_us).text(printable(pose.source)).text(printable(pose.target));
  rows.integer(pose.station).text(printable(pose.station_id));
  if (pose.pose) {
    const Quaternion q = pose.pose->quaternion();
    rows.number(q.w()).number(q.x()).number(q.y()).number(q.z());
    rows.number(pose.pose->t.x()).number(pose.pose->t.y()).number(pose.pose->t.z());
    rows.number(pose.sigma_rot_rad * kDegPerRad).number(pose.sigma_pos_m * kMmPerM);
    rows.pose(row_pose(pose));
  } else {
    rows.none(9);
  }
  rows.text(printable(pose.status)).text(printable(pose.flags));
  if (pose.pose) {
    rows.number(pose.rate_hz);
  } else {
    rows.none();
  }
  rows.number(pose.age_s * kMsPerS);
  if (pose.error) {
    rows.number(pose.error->rotation_rad * kDegPerRad).number(pose.error->position_m * kMmPerM);
  } else {
    rows.none(2);
  }
  rows.end_row();
  rows.flush();
}

}  // namespace pharos::tools
