// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Sensors farther than this from one plane (rms, m) do not count as coplanar: as the target's own check.
inline constexpr double kCoplanarThickness_m = 0.5e-3;

/// Pose of coplanar sensors from the homography between their plane and the rays (Zhang, "A Flexible New Technique for
/// Camera Calibration", PAMI 2000, section 3.1: K = I). Needs four rays; empty where the sensors are not coplanar.
StartPoses homography(const RaySet& set);

}  // namespace pharos::pose
