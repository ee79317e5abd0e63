// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <vector>

#include "host/vision/slam/frame.hpp"
#include "host/vision/slam/patch.hpp"

namespace pharos::slam {

/// Weights of visual words, by word; L1 norm 1.
using WordVector = std::map<int, double>;

/// A frame that is part of the map.
struct Keyframe : Frame {
  KeyframeId id = kNone;
  /// Covariance relative to the first keyframe, as of keyframe_covariances.
  Matrix6 covariance = Matrix6::Zero();
  WordVector words;
  /// The covisibility graph: number of points shared with each keyframe; at least kCovisible.
  std::map<KeyframeId, int> neighbours;
  /// The spanning tree; the first one has no parent.
  KeyframeId parent = kNone;
  std::set<KeyframeId> children;
  /// Closed loops: T_this_other as measured.
  std::map<KeyframeId, Pose<frame::Camera, frame::Camera>> loops;
};

/// Keyframes are covisible if they share this many points.
inline constexpr int kCovisible = 15;

/// A landmark on the target.
struct MapPoint {
  PointId id = kNone;
  Vector3 position_m = Vector3::Zero();  ///< in the target's frame
  std::map<KeyframeId, int> seen_by;     ///< feature number by keyframe
  Descriptor descriptor;                 ///< that of its observations with the smallest median distance to the others
  Vector3 normal = Vector3::Zero();      ///< mean viewing direction from the keyframes that observe it, unit
  double min_distance_m = 0.0;           ///< range of distances at which ORB's levels can detect it
  double max_distance_m = 0.0;
  int level = 0;                  ///< at which it was seen last
  std::int64_t visible = 1;       ///< frames in which it should be visible
  std::int64_t found = 1;         ///< frames in which it was found
  KeyframeId created_at = kNone;  ///< newest keyframe at its creation
  std::optional<Patch> patch;     ///< for alignment in later frames
};

/// Keyframes and points, each with the other's number. Not thread-safe: a caller that shares it must lock it.
class Map {
 public:
  std::map<KeyframeId, Keyframe> keyframes;
  std::map<PointId, MapPoint> points;

  /// Makes the frame a keyframe that observes its points; `words` may be empty.
  Keyframe& add_keyframe(const Frame& frame, WordVector words);
  MapPoint& add_point(const Vector3& position_m, KeyframeId keyframe, int feature);
  /// Adds an observation. Nothing happens where the keyframe already observes the point or its feature has one. The
  /// feature counts as a corner: it was not aligned with this point's patch.
  void observe(PointId point, KeyframeId keyframe, int feature);
  void forget_observation(PointId point, KeyframeId keyframe);
  void remove_point(PointId point);
  /// `into` takes over what `from` was seen by.
  void fuse(PointId from, PointId into);
  /// Removes a keyframe. Its children get new parents; its pose relative to its parent is kept, for trajectories.
  void remove_keyframe(KeyframeId keyframe);

  /// Recomputes the covisibility of a keyframe; one without a parent becomes a child of the one that shares most
  /// points.
  void update_neighbours(KeyframeId keyframe);
  /// Recomputes descriptor, normal and distances of a point from its observations.
  void refresh(PointId point);
  /// Up to `count` covisible keyframes, most points first.
  std::vector<KeyframeId> best_neighbours(KeyframeId keyframe, std::size_t count) const;
  /// The pose of a keyframe, also of a removed one.
  CameraFromTarget pose_of(KeyframeId keyframe) const;
  /// Its covariance; for a removed one, that of the keyframe to which its pose is relative and what lay between the two
  /// when it was removed: no later adjustment corrects that part.
  Matrix6 covariance_of(KeyframeId keyframe) const;
  /// Forgets removed keyframes, except those that own a patch and those in `kept`.
  void forget_removed(KeyframeId kept);
  std::size_t removed() const { return removed_.size(); }
  /// Number of the keyframe's points that at least `observers` keyframes observe.
  int tracked_points(const Keyframe& keyframe, std::size_t observers) const;
  const MapPoint* find_point(PointId point) const;
  KeyframeId newest() const { return next_keyframe_ - 1; }

 private:
  struct Removed {
    KeyframeId parent;
    Pose<frame::Camera, frame::Camera> T_this_parent;
    Matrix6 between;  // covariance of the one relative to the other, along the target's axes
  };
  void reparent(Keyframe& orphan, KeyframeId removed, KeyframeId grandparent);

  KeyframeId next_keyframe_ = 0;
  PointId next_point_ = 0;
  std::map<KeyframeId, Removed> removed_;
};

}  // namespace pharos::slam
