// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "host/vision/slam/keyframe_database.hpp"
#include "host/vision/slam/map.hpp"
#include "host/vision/slam/motion_prior.hpp"
#include "host/vision/slam/pose_only.hpp"
#include "host/vision/slam/projection_match.hpp"

namespace pharos::slam {

enum class TrackState { kWaiting, kTracking, kLost };

/// Result of tracking one frame.
struct Tracked {
  TrackState state = TrackState::kWaiting;
  CameraFromTarget pose;
  Matrix6 covariance = Matrix6::Zero();
  double rms_px = 0.0;
  int inliers = 0;
  bool relocalised = false;
  bool ambiguous_place = false;  ///< lost: places were recognised, but the motion rules them out, or they contradict
  bool wants_keyframe = false;
};

/// Section 2.2: estimates the pose of each frame in the map.
///
/// Prediction: the step from frame before last to last, repeated. For a target that spins at a constant rate about a
/// fixed axis in front of a fixed camera, T_k = exp(k xi) T_0: the step exp(xi) is the same in the camera's frame and
/// in the target's, so one rule applies to a tumbling target and to a moving camera. The map must not change while a
/// call runs.
class Tracker {
 public:
  Tracker(const StereoCamera& camera, Map& map, const KeyframeDatabase* keyframe_database)
      : camera_(camera), map_(map), keyframe_database_(keyframe_database) {}

  /// Sets pose and points of `frame`; moves features to the aligned positions of their points' patches in `pyramid`, of
  /// its left image (empty: none is moved). `mapping_idle` is an input of the keyframe rules.
  Tracked track(Frame& frame, bool mapping_idle, const std::vector<PyramidLevel>& pyramid);
  /// The frame became the keyframe `id` and shares its points.
  void became_keyframe(const Keyframe& keyframe);
  KeyframeId reference() const { return reference_; }
  /// Motion from the frame before to the last one; empty where one was lost.
  std::optional<Pose<frame::Camera, frame::Camera>> step() const {
    return has_step_ && state_ == TrackState::kTracking ? std::optional(step_) : std::nullopt;
  }

 private:
  /// What can be known again of a placed frame: features with a position.
  struct Known {
    std::vector<Feature> features;
    std::vector<Candidate> candidates;
  };
  Known known_in(const Frame& seen, const CameraFromTarget& seen_from) const;
  std::optional<PoseOnly> search_as_predicted(Frame& frame) const;
  std::optional<PoseOnly> search_widely(Frame& frame, const Frame& seen, const CameraFromTarget& seen_from,
                                        std::uint64_t seed) const;
  std::optional<PoseOnly> search_by_keyframe(Frame& frame, KeyframeId keyframe) const;
  std::optional<PoseOnly> follow(Frame& frame);
  bool is_near(const CameraFromTarget& pose, double time_s);
  /// The frame at a place that was recognised.
  struct Place {
    Frame frame;
    PoseOnly placed;
    KeyframeId nearest = kNone;
  };
  std::optional<PoseOnly> relocalise(Frame& frame, bool& ambiguous);
  std::vector<Place> recognised_places(const Frame& frame);
  bool same_place(const Place& a, const Place& b) const;
  void learn_motion(const CameraFromTarget& before, const CameraFromTarget& now);
  std::optional<PoseOnly> track_local_map(Frame& frame, const PoseOnly& start, double widening, int min_inliers);
  bool lacks_points(const Frame& frame) const;
  bool needs_new_keyframe(const Frame& frame, int inliers, bool mapping_idle) const;
  CameraFromTarget last_pose() const { return T_last_reference_ * map_.pose_of(reference_); }
  void remember(const Frame& frame, const PoseOnly& placed);

  StereoCamera camera_;
  Map& map_;
  const KeyframeDatabase* keyframe_database_;
  TrackState state_ = TrackState::kWaiting;
  std::vector<PyramidLevel> pyramid_;  // of the present frame
  Frame last_;
  Pose<frame::Camera, frame::Camera> T_last_reference_, step_;
  bool has_step_ = false;
  double step_s_ = 0.0;
  std::optional<MotionPrior> motion_;  // empty until two frames in a row were placed
  KeyframeId reference_ = kNone;       // to which the last frame's pose is relative
  KeyframeId nearest_ = kNone;         // that shares most points with the present frame
  std::int64_t last_keyframe_frame_ = 0, last_relocalised_ = -1000;
};

}  // namespace pharos::slam
