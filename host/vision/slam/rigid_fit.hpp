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

/// A pose from map points matched with stereo features of a frame, with many wrong matches: RANSAC (Fischler and Bolles
/// 1981) over three matches by rigid_fit, scored by reprojection, deterministic for one `seed`; then adjust_pose. Empty
/// below `min_inliers`.
std::optional<PoseOnly> robust_pose(const std::vector<Observation>& observations, const StereoCamera& camera,
                                    int min_inliers, std::uint64_t seed);

}  // namespace pharos::slam
