// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam {

/// Moves features with map points to the aligned positions of the points' patches in `pyramid`, of the frame's left
/// image, for a camera near `pose`; adapts their right columns and depths. With an empty pyramid nothing changes.
void align_with_patches(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& pose,
                        const std::vector<PyramidLevel>& pyramid);

/// The frame's pose from its points, for a start near it. Its covariance has both factors of the residuals: that of the
/// aligned patches' variance (kept in the frame) and that of errors which neighbouring points have in common. Features
/// of points that do not fit lose them.
PoseOnly place_frame(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& start);

}  // namespace pharos::slam
