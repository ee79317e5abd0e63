// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {

/// The part of the map around a frame: points of the keyframes that share points with it, and of their neighbours.
struct LocalMap {
  KeyframeId nearest = kNone;   ///< that shares most points; kNone where the frame has no map point
  std::vector<PointId> points;  ///< in order
};

/// Cosine of 60 deg: from a direction farther from the mean one of its observations a point looks different.
inline constexpr double kCosMaxTurn = 0.5;

LocalMap local_map(const Map& map, const Frame& frame);

/// Points of the local map that should be visible in a frame at `pose` and are not matched yet, with search positions;
/// `widening` multiplies the search radius. All points that should be visible are counted as such.
std::vector<Candidate> local_candidates(Map& map, const LocalMap& local, const Frame& frame, const StereoCamera& camera,
                                        const CameraFromTarget& pose, double widening);

}  // namespace pharos::slam
