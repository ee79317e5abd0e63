// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam {

/// One point in one keyframe.
struct BundleObservation {
  KeyframeId keyframe = kNone;
  PointId point = kNone;
  Observation seen;  ///< its point_m is not used
};

/// (12) as plain values, so that it can be solved while the map goes on.
struct BundleProblem {
  std::map<KeyframeId, CameraFromTarget> poses;
  std::map<KeyframeId, bool> fixed;  ///< K_F: poses that stay
  std::map<PointId, Vector3> points;
  std::vector<BundleObservation> observations;  ///< those of one point one after the other
};

/// Keyframes covisible with `keyframe` and it (K_L), the points they see, and who else sees those (K_F).
BundleProblem local_problem(const Map& map, KeyframeId keyframe, std::size_t max_keyframes);
/// All of the map; the first keyframe stays.
BundleProblem global_problem(const Map& map);

/// Solves (12) by Ceres (Levenberg and Marquardt, points eliminated first, up to so many steps twice), in place;
/// Huber's cost, and once more without what chi-squared rejects. Returns the rejected observations' numbers. Same
/// input, same bits.
std::vector<std::size_t> adjust_bundle(BundleProblem& problem, const StereoCamera& camera, int iterations);

/// Puts a solution into the map: poses and points that are still there; rejected observations go.
void apply(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map);

}  // namespace pharos::slam
