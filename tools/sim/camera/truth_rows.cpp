// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/truth_rows.hpp"

#include <charconv>

#include "host/support/input_error.hpp"

namespace pharos::sim {

TruthRows::TruthRows(const std::string& file) : file_(file) {
  if (!file_) throw host::InputError(file + ": cannot be written");
  file_ << "utime,qw,qx,qy,qz,tx_m,ty_m,tz_m" << std::endl;
}

void TruthRows::add(std::int64_t utc_ns, const Pose<frame::Camera, frame::Target>& T_camera_target) {
  const std::int64_t utime = utc_ns / 1000;
  if (utime <= last_us_) return;  // this computer's clock was set back: rows go forwards only
  last_us_ = utime;
  Quaternion q(T_camera_target.R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vector3& t = T_camera_target.t;
  std::string row = std::to_string(utime);
  for (const double value : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) {
    char digits[32];
    row.push_back(',');
    row.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  file_ << row << std::endl;
}

}  // namespace pharos::sim
