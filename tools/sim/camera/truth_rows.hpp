// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "pharos/geometry/pose.hpp"

namespace pharos::sim {

/// The true pose of every frame as it is shown: `utime,qw,qx,qy,qz,tx_m,ty_m,tz_m`, utime in microseconds UTC.
class TruthRows {
 public:
  /// Throws host::InputError when the file cannot be written.
  explicit TruthRows(const std::string& file);
  void add(std::int64_t utc_ns, const Pose<frame::Camera, frame::Target>& T_camera_target);

 private:
  std::ofstream file_;
  std::int64_t last_us_ = 0;
};

}  // namespace pharos::sim
