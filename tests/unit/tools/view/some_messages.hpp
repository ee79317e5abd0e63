// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/pose_t.hpp"

namespace pharos::test {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A valid pose of a lighthouse at 2 m.
inline pose_t some_pose(std::int64_t sequence = 0) {
  pose_t pose{};
  pose.sequence = sequence;
  pose.source = "lighthouse/chaser";
  pose.target = "dock";
  pose.station_or_camera = "C33B4DE1";
  pose.parent_frame = "lighthouse";
  pose.child_frame = "body";
  pose.status = "ok";
  pose.valid = 1;
  pose.position_m[0] = 0.5;
  pose.position_m[1] = -0.25;
  pose.position_m[2] = 2.0;
  pose.orientation_wxyz[0] = 1.0;
  pose.covariance[21] = 1e-6;
  pose.sigma_pos_m = 0.001;
  pose.sigma_rot_rad = 0.002;
  return pose;
}

}  // namespace pharos::test
