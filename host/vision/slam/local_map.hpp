// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {

/// What of the map is about a frame: points of the keyframes that share points with it, and of those near to these.
struct LocalMap {
  KeyframeId nearest = kNone;   ///< that shares most; kNone where the frame shows no point
  std::vector<PointId> points;  ///< in order
};

LocalMap local_map(const Map& map, const Frame& frame);

/// Points of the local map that a frame at `pose` should see and does not show yet, with where to look; `widening` of
/// the radius. All that it should see are counted as visible.
std::vector<Candidate> local_candidates(Map& map, const LocalMap& local, const Frame& frame, const StereoCamera& camera,
                                        const CameraFromTarget& pose, double widening);

}  // namespace pharos::slam
