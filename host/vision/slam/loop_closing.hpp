// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/slam/bundle.hpp"
#include "host/vision/slam/keyframe_database.hpp"
#include "host/vision/slam/loop_counts.hpp"
#include "host/vision/slam/map.hpp"
#include "host/vision/slam/pose_graph.hpp"
#include "host/vision/slam/provisional_loop.hpp"

namespace pharos::slam {

/// What a keyframe changed about loops.
struct LoopDecision {
  std::optional<Loop> close, taken_back;
};

/// Section 2.4: detects a loop and corrects the map by it (Mur-Artal 2017: with a stereo camera the error has six
/// degrees of freedom).
class LoopCloser {
 public:
  LoopCloser(const StereoCamera& camera, Map& map, const KeyframeDatabase& keyframe_database)
      : camera_(camera), map_(map), keyframe_database_(keyframe_database) {}

  /// Candidates that share points neither with the keyframe nor with its neighbours: by visual words, three at most,
  /// and the one of the most similar view as the trajectory tells. Each is checked by robust_pose (or from where the
  /// trajectory says), then with all points of its neighbourhood: 40 inliers close a loop, where the pose
  /// agrees with the trajectory (place_gate.hpp), the points are not on one plane, neighbours of the keyframe find the
  /// place too (loop_evidence.hpp), and no other candidate asks for another pose.
  /// `pyramid`: of the keyframe's left image, in which the place's patches are aligned; empty: they stay corners.
  std::optional<Loop> find(KeyframeId keyframe, const std::vector<PyramidLevel>& pyramid = {});
  /// For every keyframe, in order: find(), or, where a loop was found, whether this keyframe confirms it
  /// (provisional_loop.hpp). A loop to close has to be given to correct().
  LoopDecision decide(KeyframeId keyframe, const std::vector<PyramidLevel>& pyramid = {});
  /// Moves the keyframe and its neighbours to the corrected poses, fuses duplicate points, and distributes the
  /// remaining error over all others by the essential graph (spanning tree, strong covisibility, loops).
  void correct(const Loop& loop);
  int refused() const { return refused_; }
  const LoopCounts& counts() const { return counts_; }

 private:
  std::vector<KeyframeId> candidates_of(const Keyframe& here, const std::set<KeyframeId>& connected) const;
  std::optional<Loop> check(const Keyframe& here, KeyframeId candidate, const std::vector<PyramidLevel>& pyramid);
  CameraFromTarget start_at(const Keyframe& here, const Keyframe& there) const;
  std::optional<Loop> fit(const Keyframe& here, KeyframeId candidate, const std::vector<PyramidLevel>& pyramid) const;
  bool observe_aligned(const Loop& loop);
  void fuse_sides(const Loop& loop, const std::vector<KeyframeId>& side);
  std::vector<PoseEdge> essential_edges(const std::map<KeyframeId, CameraFromTarget>& before) const;
  void move_side(const Loop& loop, const std::vector<KeyframeId>& side);

  StereoCamera camera_;
  Map& map_;
  const KeyframeDatabase& keyframe_database_;
  KeyframeId closed_at_ = kNone;
  std::optional<ProvisionalLoop> provisional_;
  int refused_ = 0;
  LoopCounts counts_;
};

/// Writes the solution of a global problem into a map that grew meanwhile: later keyframes move with their parents,
/// later points with the keyframes that observe them.
void apply_global(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map);

}  // namespace pharos::slam
