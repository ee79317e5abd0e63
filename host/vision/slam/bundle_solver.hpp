// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include "host/vision/slam/bundle.hpp"

namespace pharos::slam {

/// Ceres' options for (12): the points, group 0 of `ordering`, are eliminated first. Deterministic.
ceres::Solver::Options bundle_options(ceres::ParameterBlockOrdering* ordering, std::size_t moving_poses,
                                      int iterations);

/// Whether the point is in front of the camera.
bool in_front(const CameraFromTarget& pose, const Vector3& point_m);
/// The same, and whether chi-squared accepts the observation.
bool fits(const Observation& seen, const Vector3& point_m, const CameraFromTarget& pose, const StereoCamera& camera);

}  // namespace pharos::slam
