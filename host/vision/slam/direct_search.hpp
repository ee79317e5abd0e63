// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {

/// Finds the patches of points that no corner was matched with where `pose` predicts them (accurate to a pixel): an
/// unmatched corner there observes the point, else the frame gets a feature of its own without depth. Returns how many.
int search_patches(Frame& frame, const Map& map, const std::vector<Candidate>& candidates, const StereoCamera& camera,
                   const CameraFromTarget& pose, const std::vector<PyramidLevel>& pyramid);

}  // namespace pharos::slam
