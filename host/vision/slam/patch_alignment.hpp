// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"

namespace pharos::slam {

/// Moves features with map points to the aligned positions of the points' patches in `pyramid`, of the frame's left
/// image, for a camera near `pose`; adapts their right columns and depths. With an empty pyramid nothing changes.
void align_with_patches(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& pose,
                        const std::vector<PyramidLevel>& pyramid);

}  // namespace pharos::slam
