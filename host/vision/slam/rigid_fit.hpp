// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam {

/// The pose that takes `points` to `seen` with least squares: p_seen = R p + t (Horn 1987, by singular values). At
/// least three points that are not on one line.
std::optional<CameraFromTarget> rigid_fit(const std::vector<Vector3>& points, const std::vector<Vector3>& seen);

/// A pose from points of the map matched with stereo features of a frame, many matches wrong: three at a time by
/// rigid_fit, judged by reprojection (RANSAC, Fischler and Bolles 1981; the same `seed`, the same answer), then
/// adjust_pose. Empty below `min_inliers`.
std::optional<PoseOnly> robust_pose(const std::vector<Observation>& observations, const StereoCamera& camera,
                                    int min_inliers, std::uint64_t seed);

}  // namespace pharos::slam
