// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/vision/slam/local_map.hpp"
#include "host/vision/slam/patch_alignment.hpp"
#include "host/vision/slam/place_gate.hpp"
#include "host/vision/slam/rigid_fit.hpp"

namespace pharos::slam {
namespace {

constexpr double kMotionRadius_px = 7.0;  // around a predicted position; tripled where there are too few matches
constexpr int kMinByMotion = 20;
constexpr int kMinPlaced = 15;      // inliers of the first pose estimate
constexpr int kMinInLocalMap = 30;  // inliers in the local map: below, the frame is lost
constexpr int kMinRelocalised = 50;
constexpr std::size_t kMaxCandidates = 5;  // keyframes tried to relocalise
constexpr double kMaxTurnSteps = 20.0;     // longest prediction over missing frames, in steps
// Section 2.2, rules (1) to (4).
constexpr std::int64_t kFramesBetween = 20;
constexpr int kMinTracked = 50;
constexpr double kShareOfReference = 0.9;

}  // namespace

PoseOnly Tracker::adjust(Frame& frame, const CameraFromTarget& start) const {
  std::vector<Observation> observations;
  std::vector<std::size_t> features;
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    const MapPoint* point = map_.find_point(frame.points[k]);
    if (point == nullptr) continue;
    observations.push_back(observation_of(frame.features[k], point->position_m));
    features.push_back(k);
  }
  PoseOnly placed = adjust_pose(observations, camera_, start);
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (!placed.inlier[k]) frame.points[features[k]] = kNone;
  }
  return placed;
}

std::optional<PoseOnly> Tracker::track_motion_model(Frame& frame) {
  CameraFromTarget predicted = last_pose();
  if (has_step_) {
    const double steps = std::clamp(std::round((frame.time_s - last_.time_s) / step_s_), 1.0, kMaxTurnSteps);
    for (int k = 0; k < static_cast<int>(steps); ++k) predicted = step_ * predicted;
  }
  // Map points matched in the last frame, and its stereo features without a point.
  const Pose<frame::Target, frame::Camera> T_target_last = last_pose().inverse();
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < last_.features.size(); ++k) {
    const Feature& feature = last_.features[k];
    const MapPoint* point = map_.find_point(last_.points[k]);
    if (point == nullptr && !feature.stereo()) continue;
    const Vector3 position =
        point != nullptr ? point->position_m : T_target_last * camera_.back_project(feature.pixel, feature.depth_m);
    candidates.push_back({point != nullptr ? point->id : kNone, position, feature.descriptor, feature.level,
                          kMotionRadius_px, feature.angle_rad});
  }
  std::vector<ProjectionMatch> matches;
  for (const double widening : {1.0, 3.0}) {
    for (Candidate& candidate : candidates) candidate.radius_px = widening * kMotionRadius_px;
    matches = match_by_projection(candidates, frame, {}, camera_, predicted, {kHighDistanceThreshold, 0.9, true});
    if (static_cast<int>(matches.size()) >= kMinByMotion) break;
  }
  if (static_cast<int>(matches.size()) < kMinByMotion) return std::nullopt;
  std::vector<Observation> observations;
  for (const ProjectionMatch& match : matches) {
    observations.push_back(observation_of(frame.features[static_cast<std::size_t>(match.feature)],
                                          candidates[static_cast<std::size_t>(match.candidate)].position_m));
  }
  const PoseOnly placed = adjust_pose(observations, camera_, predicted);
  if (placed.inliers < kMinPlaced) return std::nullopt;
  std::fill(frame.points.begin(), frame.points.end(), kNone);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (placed.inlier[k]) {
      frame.points[static_cast<std::size_t>(matches[k].feature)] =
          candidates[static_cast<std::size_t>(matches[k].candidate)].point;
    }
  }
  return placed;
}

std::optional<PoseOnly> Tracker::match_reference_keyframe(Frame& frame, KeyframeId id, int min_inliers) {
  const auto at = map_.keyframes.find(id);
  if (at == map_.keyframes.end()) return std::nullopt;
  const Keyframe& keyframe = at->second;
  std::vector<bool> known(keyframe.points.size());
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = keyframe.points[k] != kNone;
  const auto matches = match_by_descriptor(keyframe.features, known, frame.features, {}, 0.8);
  std::vector<Observation> observations;
  for (const ProjectionMatch& match : matches) {
    const PointId point = keyframe.points[static_cast<std::size_t>(match.candidate)];
    observations.push_back(
        observation_of(frame.features[static_cast<std::size_t>(match.feature)], map_.points.at(point).position_m));
  }
  const auto placed =
      robust_pose(observations, camera_, min_inliers, static_cast<std::uint64_t>(frame.number * 4096 + id));
  if (!placed) return std::nullopt;
  std::fill(frame.points.begin(), frame.points.end(), kNone);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (placed->inlier[k]) {
      frame.points[static_cast<std::size_t>(matches[k].feature)] =
          keyframe.points[static_cast<std::size_t>(matches[k].candidate)];
    }
  }
  return placed;
}

bool Tracker::same_place(const Place& a, const Place& b) const {
  const Matrix6 covariance = in_target_axes(a.placed.pose, a.placed.covariance) +
                             in_target_axes(b.placed.pose, b.placed.covariance) +
                             drift_between(map_, a.nearest, b.nearest, camera_);
  return !contradicts(place_offset(a.placed.pose, b.placed.pose), covariance);
}

// One for each pose: of places that agree, the one whose keyframe is most similar.
std::vector<Tracker::Place> Tracker::recognised_places(const Frame& frame) {
  std::vector<KeyframeId> candidates;
  if (keyframe_database_ == nullptr) {
    candidates.push_back(reference_);
  } else {
    for (const auto& like :
         keyframe_database_->detect_candidates(keyframe_database_->words_of(frame.features), map_, {})) {
      if (candidates.size() < kMaxCandidates) candidates.push_back(like.keyframe);
    }
  }
  std::vector<Place> places;
  for (const KeyframeId id : candidates) {
    Place place{frame, {}, id};
    const auto start = match_reference_keyframe(place.frame, id, kMinPlaced);
    if (!start) continue;
    const auto placed = track_local_map(place.frame, *start, true);
    if (!placed) continue;
    place.placed = *placed;
    place.nearest = nearest_;
    const bool known =
        std::any_of(places.begin(), places.end(), [&](const Place& at) { return same_place(at, place); });
    if (!known) places.push_back(std::move(place));
  }
  return places;
}

std::optional<PoseOnly> Tracker::relocalise(Frame& frame, bool& ambiguous) {
  std::vector<Place> places = recognised_places(frame);
  ambiguous = !places.empty();
  if (motion_) {
    motion_->last = last_pose();  // corrections of the map move it
    std::erase_if(places, [&](const Place& place) {
      return !can_have_come_to(*motion_, place.placed.pose, frame.time_s - last_.time_s);
    });
  }
  if (places.size() != 1) return std::nullopt;
  ambiguous = false;
  frame = std::move(places.front().frame);
  nearest_ = places.front().nearest;
  return places.front().placed;
}

std::optional<PoseOnly> Tracker::track_local_map(Frame& frame, const PoseOnly& start, bool wide) {
  const LocalMap local = local_map(map_, frame);
  if (local.nearest != kNone) nearest_ = local.nearest;
  std::vector<bool> free(frame.points.size());
  for (std::size_t k = 0; k < free.size(); ++k) free[k] = frame.points[k] == kNone;
  const std::vector<Candidate> candidates = local_candidates(map_, local, frame, camera_, start.pose, wide ? 3.0 : 1.0);
  for (const ProjectionMatch& match :
       match_by_projection(candidates, frame, free, camera_, start.pose, {kHighDistanceThreshold, 0.8, false})) {
    frame.points[static_cast<std::size_t>(match.feature)] = candidates[static_cast<std::size_t>(match.candidate)].point;
  }
  align_with_patches(frame, map_, camera_, start.pose, pyramid_);
  PoseOnly placed = adjust(frame, start.pose);
  for (const PointId id : frame.points) {
    if (id != kNone) ++map_.points.at(id).found;
  }
  if (placed.inliers < (wide ? kMinRelocalised : kMinInLocalMap)) return std::nullopt;
  return placed;
}

bool Tracker::needs_new_keyframe(const Frame& frame, int inliers, bool mapping_idle) const {
  if (frame.number < last_relocalised_ + kFramesBetween) return false;                      // (1)
  if (!mapping_idle && frame.number < last_keyframe_frame_ + kFramesBetween) return false;  // (2)
  if (inliers < kMinTracked) return false;                                                  // (3)
  const Keyframe& reference = map_.keyframes.at(nearest_);
  // A point that only the reference has observed may not be trackable.
  const std::size_t observers = map_.keyframes.size() == 1 ? 1 : 2;
  return inliers < kShareOfReference * map_.tracked_points(reference, observers);  // (4)
}

void Tracker::remember(const Frame& frame, const PoseOnly& placed) {
  const CameraFromTarget before = state_ == TrackState::kTracking ? last_pose() : placed.pose;
  const double elapsed = frame.time_s - last_.time_s;
  has_step_ = state_ == TrackState::kTracking && elapsed > 0.0;
  if (has_step_) {
    step_ = placed.pose * before.inverse();
    step_s_ = elapsed;
    learn_motion(before, placed.pose);
  }
  last_ = frame;
  T_last_reference_ = placed.pose * map_.pose_of(reference_).inverse();
  state_ = TrackState::kTracking;
}

void Tracker::learn_motion(const CameraFromTarget& before, const CameraFromTarget& now) {
  Vector3 centre = Vector3::Zero();
  double count = 0.0;
  for (const PointId id : last_.points) {
    const MapPoint* point = map_.find_point(id);
    if (point == nullptr) continue;
    centre += point->position_m;
    count += 1.0;
  }
  if (!(count > 0.0)) return;
  centre /= count;
  motion_ = MotionPrior{now, centre, rotation_angle_between(now.R, before.R) / step_s_,
                        (now * centre - before * centre).norm() / step_s_};
}

Tracked Tracker::track(Frame& frame, bool mapping_idle, const std::vector<PyramidLevel>& pyramid) {
  frame.points.assign(frame.features.size(), kNone);
  pyramid_ = pyramid;
  Tracked out;
  if (map_.keyframes.empty()) return out;
  std::optional<PoseOnly> placed;
  if (state_ == TrackState::kTracking) {
    placed = track_motion_model(frame);
    if (!placed) placed = match_reference_keyframe(frame, reference_, kMinPlaced);
    if (placed) placed = track_local_map(frame, *placed, false);
  }
  if (!placed) {
    placed = relocalise(frame, out.ambiguous_place);
    out.relocalised = placed.has_value();
    if (placed) last_relocalised_ = frame.number;
  }
  if (!placed) {
    std::fill(frame.points.begin(), frame.points.end(), kNone);
    out.state = state_ = TrackState::kLost;
    return out;
  }
  frame.pose = placed->pose;
  if (out.relocalised) state_ = TrackState::kLost;  // the step across the gap is not a motion estimate
  const CameraFromTarget last = last_pose();
  reference_ = nearest_;
  T_last_reference_ = last * map_.pose_of(reference_).inverse();
  remember(frame, *placed);
  out.state = TrackState::kTracking;
  out.pose = placed->pose;
  out.covariance = placed->covariance;
  out.rms_px = placed->rms_px;
  out.inliers = placed->inliers;
  out.wants_keyframe = needs_new_keyframe(frame, placed->inliers, mapping_idle);
  return out;
}

void Tracker::became_keyframe(const Keyframe& keyframe) {
  reference_ = keyframe.id;
  last_ = static_cast<const Frame&>(keyframe);
  T_last_reference_ = last_.pose * keyframe.pose.inverse();
  last_keyframe_frame_ = keyframe.number;
  state_ = TrackState::kTracking;
}

}  // namespace pharos::slam
