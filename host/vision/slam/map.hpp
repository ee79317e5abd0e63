// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <vector>

#include "host/vision/slam/frame.hpp"
#include "host/vision/slam/patch.hpp"

namespace pharos::slam {

/// Weights of visual words, by word; length 1 in the sum of magnitudes.
using WordVector = std::map<int, double>;

/// A frame that the map remembers.
struct Keyframe : Frame {
  KeyframeId id = kNone;
  /// Of where it stands from the first one, as keyframe_covariances tells it.
  Matrix6 covariance = Matrix6::Zero();
  WordVector words;
  /// The covisibility graph: how many points it shares with whom; at least kCovisible.
  std::map<KeyframeId, int> neighbours;
  /// The spanning tree; the first one has no parent.
  KeyframeId parent = kNone;
  std::set<KeyframeId> children;
  /// Closed loops: T_this_other as measured.
  std::map<KeyframeId, Pose<frame::Camera, frame::Camera>> loops;
};

/// Keyframes are covisible that share so many points.
inline constexpr int kCovisible = 15;

/// A landmark on the target.
struct MapPoint {
  PointId id = kNone;
  Vector3 position_m = Vector3::Zero();  ///< in the target's frame
  std::map<KeyframeId, int> seen_by;     ///< feature number by keyframe
  Descriptor descriptor;                 ///< the most typical of those that saw it
  Vector3 normal = Vector3::Zero();      ///< mean direction from its viewers to it, unit
  double min_distance_m = 0.0;           ///< range of distances at which ORB's levels can find it
  double max_distance_m = 0.0;
  int level = 0;                  ///< at which it was seen last
  std::int64_t visible = 1;       ///< frames that should have seen it
  std::int64_t found = 1;         ///< frames that did
  KeyframeId created_at = kNone;  ///< newest keyframe then
  std::optional<Patch> patch;     ///< with which later frames find it again
};

/// Keyframes and points, each holding the other's number. Plain data under one owner: who shares it locks it.
class Map {
 public:
  std::map<KeyframeId, Keyframe> keyframes;
  std::map<PointId, MapPoint> points;

  /// The frame becomes a keyframe seen from its points; `words` may be empty.
  Keyframe& add_keyframe(const Frame& frame, WordVector words);
  MapPoint& add_point(const Vector3& position_m, KeyframeId keyframe, int feature);
  /// Nothing happens where the keyframe sees the point already or its feature has one. The feature counts as a corner:
  /// nobody aligned it with this point's patch.
  void observe(PointId point, KeyframeId keyframe, int feature);
  void forget_observation(PointId point, KeyframeId keyframe);
  void remove_point(PointId point);
  /// `into` takes over what `from` was seen by.
  void fuse(PointId from, PointId into);
  /// Its children get new parents; where it stood is remembered relative to its parent, for trajectories.
  void remove_keyframe(KeyframeId keyframe);

  /// Counts shared points anew and hangs a keyframe without a parent under the one that shares most.
  void update_neighbours(KeyframeId keyframe);
  /// Descriptor, normal and distances of a point from those that see it.
  void refresh(PointId point);
  /// Up to `count` covisible keyframes, most points first.
  std::vector<KeyframeId> best_neighbours(KeyframeId keyframe, std::size_t count) const;
  /// The pose of a keyframe, also of a removed one.
  CameraFromTarget pose_of(KeyframeId keyframe) const;
  /// Its covariance; of a removed one, that of the keyframe it is told from.
  const Matrix6& covariance_of(KeyframeId keyframe) const;
  /// Removed keyframes that neither a patch is of nor `kept` is, are no longer known.
  void forget_removed(KeyframeId kept);
  std::size_t removed() const { return removed_.size(); }
  /// Points of the keyframe that at least `observers` keyframes see.
  int tracked_points(const Keyframe& keyframe, std::size_t observers) const;
  const MapPoint* find_point(PointId point) const;
  KeyframeId newest() const { return next_keyframe_ - 1; }

 private:
  struct Removed {
    KeyframeId parent;
    Pose<frame::Camera, frame::Camera> T_this_parent;
  };
  void reparent(Keyframe& orphan, KeyframeId removed, KeyframeId grandparent);

  KeyframeId next_keyframe_ = 0;
  PointId next_point_ = 0;
  std::map<KeyframeId, Removed> removed_;
};

}  // namespace pharos::slam
