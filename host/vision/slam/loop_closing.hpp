// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/slam/bundle.hpp"
#include "host/vision/slam/keyframe_database.hpp"
#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_graph.hpp"

namespace pharos::slam {

/// A keyframe that shows what the map has elsewhere.
struct Loop {
  KeyframeId here = kNone;
  KeyframeId there = kNone;
  CameraFromTarget corrected;  ///< where `here` stands if `there` is right
  /// Features of `here` and the points of `there`'s side that they show.
  std::vector<std::pair<int, PointId>> seen;
};

/// Section 2.4: finds a keyframe again and makes the map agree with it (Mur-Artal 2017: with a stereo camera the error
/// is one of six degrees of freedom).
class LoopCloser {
 public:
  LoopCloser(const StereoCamera& camera, Map& map, const KeyframeDatabase& keyframe_database)
      : camera_(camera), map_(map), keyframe_database_(keyframe_database) {}

  /// Candidates by words that neither share points with the keyframe nor with its neighbours, three at most; each by
  /// robust_pose, then by all points of its surroundings: 40 inliers close a loop.
  std::optional<Loop> find(KeyframeId keyframe);
  /// Keyframe and neighbours move to where the loop says, double points become one, and the essential graph (spanning
  /// tree, strong covisibility, loops) spreads the rest over all others.
  void correct(const Loop& loop);
  int refused() const { return refused_; }

 private:
  std::optional<Loop> check(const Keyframe& here, KeyframeId candidate);
  std::vector<PoseEdge> essential_edges(const std::map<KeyframeId, CameraFromTarget>& before) const;
  void move_side(const Loop& loop, const std::vector<KeyframeId>& side);

  StereoCamera camera_;
  Map& map_;
  const KeyframeDatabase& keyframe_database_;
  KeyframeId closed_at_ = kNone;
  int refused_ = 0;
};

/// Puts the solution of a global problem into a map that grew meanwhile: later keyframes move with their parents, later
/// points with their viewers.
void apply_global(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map);

}  // namespace pharos::slam
