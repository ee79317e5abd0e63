// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "host/vision/slam/bundle.hpp"
#include "host/vision/slam/map.hpp"

namespace pharos::slam {

inline constexpr std::size_t kAllKeyframes = static_cast<std::size_t>(-1);

struct KeyframeCovariances {
  /// Of independent errors of the assumed variances.
  std::map<KeyframeId, Matrix6> independent;
  /// By which errors in common make them larger, at least 1: light and gloss move neighbouring points alike, and
  /// residuals of one point are related from keyframe to keyframe. How far the residuals of groups of some 30
  /// neighbouring points, over all keyframes, pull the poses, relative to independent residuals (a sandwich estimator
  /// with these groups as clusters: Liang and Zeger 1986). An error that all points share is not seen.
  double correlation_factor = 1.0;
};

/// Covariance of the keyframes of a solved problem relative to one of them, `root`: the inverse of (12)'s normal
/// equations with the points eliminated and `root` fixed. Each keyframe's observations count with its variance_factors.
/// Rejected observations do not count; of more than `most` keyframes only those that observe most of the points are
/// used. Each covariance is that of zeta in T_camera_target exp(zeta), rotation (rad) before translation (m) about the
/// target's axes: there, a common error of a part of the map has the same value for all its keyframes. A keyframe
/// without shared points has 1 rad and 100 m. Some 12 ms for 40 keyframes with 17,000 points in all, 0.35 s for 157.
KeyframeCovariances keyframe_covariances(const BundleProblem& problem, const std::vector<std::size_t>& rejected,
                                         const StereoCamera& camera, KeyframeId root,
                                         std::size_t maximum = kAllKeyframes);

/// Sets the covariance of a keyframe from the neighbour for which the sum of the neighbour's covariance and the
/// relative one is smallest: `about` is from keyframe_covariances with this keyframe as root. Unchanged where it has no
/// neighbour.
void chain_covariance(Map& map, KeyframeId keyframe, const KeyframeCovariances& about);

/// Sets the covariances of a problem with the map's first keyframe as root, for keyframes that still exist.
void apply_covariances(const KeyframeCovariances& covariances, Map& map);

/// Rotates both parts of a covariance from one frame's axes to another's: with the pose's R, from the covariance of
/// zeta to that of Pose::moved_by's delta.
Matrix6 turned(const Matrix3& R, const Matrix6& covariance);

}  // namespace pharos::slam
