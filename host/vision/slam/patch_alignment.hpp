// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"

namespace pharos::slam {

/// Features that show points of the map go to where `pyramid`, of the frame's left image, shows the points' patches
/// from about `pose`; with them their right columns and depths. An empty pyramid moves none.
void align_with_patches(Frame& frame, const Map& map, const StereoCamera& camera, const CameraFromTarget& pose,
                        const std::vector<PyramidLevel>& pyramid);

}  // namespace pharos::slam
