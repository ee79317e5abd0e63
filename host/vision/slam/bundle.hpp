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

/// (12) as plain values, so that it can be solved while the map is used.
struct BundleProblem {
  std::map<KeyframeId, CameraFromTarget> poses;
  std::map<KeyframeId, bool> fixed;  ///< K_F: fixed poses
  std::map<PointId, Vector3> points;
  std::vector<BundleObservation> observations;  ///< grouped by point
  /// Of the keyframes' observations (Frame::variance_factor): it changes no weight, only what is stated of the
  /// solution.
  std::map<KeyframeId, double> variance_factors;
};

/// `keyframe` and its covisible keyframes (K_L), their points, and the other keyframes that observe those (K_F).
BundleProblem local_problem(const Map& map, KeyframeId keyframe, std::size_t max_keyframes);
/// The whole map; the first keyframe is fixed.
BundleProblem global_problem(const Map& map);

/// Solves (12) by Ceres (Levenberg and Marquardt, points eliminated first, up to so many steps twice), in place;
/// Huber's cost, and once more without observations that chi-squared rejects. Returns the rejected observations'
/// numbers. Deterministic.
std::vector<std::size_t> adjust_bundle(BundleProblem& problem, const StereoCamera& camera, int iterations);

/// Writes a solution into the map: poses and points that still exist; removes rejected observations.
void apply(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map);

}  // namespace pharos::slam
