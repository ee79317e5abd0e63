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
constexpr double kWideStart = 2.0;        // of the local map's radii, where the start is not from the predicted motion
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

// Keyframe at once: with fewer points among the near features than the first number, and more without one than the
// second (Mur-Artal 2017, section III.E): the next frames would find too few.
constexpr int kMinNear = 100, kMinNearWithout = 70;

std::vector<Observation> observations_of(const std::vector<ProjectionMatch>& matches,
                                         const std::vector<Candidate>& candidates, const Frame& frame) {
  std::vector<Observation> observations;
  for (const ProjectionMatch& match : matches) {
    observations.push_back(observation_of(frame.features[static_cast<std::size_t>(match.feature)],
                                          candidates[static_cast<std::size_t>(match.candidate)].position_m));
  }
  return observations;
}

// The frame gets the points of the matches that fit.
void take_points(const std::vector<ProjectionMatch>& matches, const std::vector<Candidate>& candidates,
                 const PoseOnly& placed, Frame& frame) {
  std::fill(frame.points.begin(), frame.points.end(), kNone);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (!placed.inlier[k]) continue;
    frame.points[static_cast<std::size_t>(matches[k].feature)] =
        candidates[static_cast<std::size_t>(matches[k].candidate)].point;
  }
}

}  // namespace

// A placed frame's points of the map, and its stereo features without one.
Tracker::Known Tracker::known_in(const Frame& seen, const CameraFromTarget& seen_from) const {
  const Pose<frame::Target, frame::Camera> T_target_seen = seen_from.inverse();
  Known known;
  for (std::size_t k = 0; k < seen.features.size(); ++k) {
    const Feature& feature = seen.features[k];
    const MapPoint* point = map_.find_point(seen.points[k]);
    if (point == nullptr && !feature.stereo()) continue;
    const Vector3 position =
        point != nullptr ? point->position_m : T_target_seen * camera_.back_project(feature.pixel, feature.depth_m);
    known.features.push_back(feature);
    known.candidates.push_back({point != nullptr ? point->id : kNone, position, feature.descriptor, feature.level,
                                kMotionRadius_px, feature.angle_rad});
  }
  return known;
}

std::optional<PoseOnly> Tracker::search_as_predicted(Frame& frame) const {
  CameraFromTarget predicted = last_pose();
  if (has_step_) {
    const double steps = std::clamp(std::round((frame.time_s - last_.time_s) / step_s_), 1.0, kMaxTurnSteps);
    for (int k = 0; k < static_cast<int>(steps); ++k) predicted = step_ * predicted;
  }
  std::vector<Candidate> candidates = known_in(last_, last_pose()).candidates;
  std::vector<ProjectionMatch> matches;
  for (const double widening : {1.0, 3.0}) {
    for (Candidate& candidate : candidates) candidate.radius_px = widening * kMotionRadius_px;
    matches = match_by_projection(candidates, frame, {}, camera_, predicted, {kHighDistanceThreshold, 0.9, true});
    if (static_cast<int>(matches.size()) >= kMinByMotion) break;
  }
  if (static_cast<int>(matches.size()) < kMinByMotion) return std::nullopt;
  const PoseOnly placed = adjust_pose(observations_of(matches, candidates, frame), camera_, predicted);
  if (placed.inliers < kMinPlaced) return std::nullopt;
  take_points(matches, candidates, placed, frame);
  return placed;
}

std::optional<PoseOnly> Tracker::search_widely(Frame& frame, const Frame& seen, const CameraFromTarget& seen_from,
                                               std::uint64_t seed) const {
  const Known known = known_in(seen, seen_from);
  const auto matches = match_by_descriptor(known.features, {}, frame.features, {}, 0.8);
  const auto placed = robust_pose(observations_of(matches, known.candidates, frame), camera_, kMinPlaced, seed);
  if (placed) take_points(matches, known.candidates, *placed, frame);
  return placed;
}

std::optional<PoseOnly> Tracker::search_by_keyframe(Frame& frame, KeyframeId id) const {
  const auto at = map_.keyframes.find(id);
  if (at == map_.keyframes.end()) return std::nullopt;
  return search_widely(frame, at->second, at->second.pose, static_cast<std::uint64_t>(frame.number * 4096 + id));
}

// The frame from the one before. Where its features are not where the motion predicts, they are searched in the whole
// image: those of the reference keyframe, then those of the last frame. Each start has to prove itself in the local
// map, because wrong matches may agree by chance.
std::optional<PoseOnly> Tracker::follow(Frame& frame) {
  const Frame untouched = frame;
  if (const auto start = search_as_predicted(frame)) {
    if (auto placed = track_local_map(frame, *start, 1.0, kMinInLocalMap)) return placed;
  }
  for (const bool by_keyframe : {true, false}) {
    frame = untouched;
    const auto start = by_keyframe ? search_by_keyframe(frame, reference_)
                                   : search_widely(frame, last_, last_pose(), static_cast<std::uint64_t>(frame.number));
    if (!start || !is_near(start->pose, frame.time_s)) continue;
    if (auto placed = track_local_map(frame, *start, kWideStart, kMinInLocalMap)) return placed;
  }
  frame = untouched;
  return std::nullopt;
}

bool Tracker::is_near(const CameraFromTarget& pose, double time_s) {
  if (!motion_) return true;
  motion_->last = last_pose();  // corrections of the map move it
  return can_have_come_to(*motion_, pose, time_s - last_.time_s);
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
    const auto start = search_by_keyframe(place.frame, id);
    if (!start) continue;
    const auto placed = track_local_map(place.frame, *start, 3.0, kMinRelocalised);
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
  std::erase_if(places, [&](const Place& place) { return !is_near(place.placed.pose, frame.time_s); });
  if (places.size() != 1) return std::nullopt;
  ambiguous = false;
  frame = std::move(places.front().frame);
  nearest_ = places.front().nearest;
  return places.front().placed;
}

std::optional<PoseOnly> Tracker::track_local_map(Frame& frame, const PoseOnly& start, double widening,
                                                 int min_inliers) {
  const LocalMap local = local_map(map_, frame);
  if (local.nearest != kNone) nearest_ = local.nearest;
  std::vector<bool> free(frame.points.size());
  for (std::size_t k = 0; k < free.size(); ++k) free[k] = frame.points[k] == kNone;
  const std::vector<Candidate> candidates = local_candidates(map_, local, frame, camera_, start.pose, widening);
  for (const ProjectionMatch& match :
       match_by_projection(candidates, frame, free, camera_, start.pose, {kHighDistanceThreshold, 0.8, false})) {
    frame.points[static_cast<std::size_t>(match.feature)] = candidates[static_cast<std::size_t>(match.candidate)].point;
  }
  align_with_patches(frame, map_, camera_, start.pose, pyramid_);
  PoseOnly placed = place_frame(frame, map_, camera_, start.pose);
  for (const PointId id : frame.points) {
    if (id != kNone) ++map_.points.at(id).found;
  }
  if (placed.inliers < min_inliers) return std::nullopt;
  return placed;
}

bool Tracker::lacks_points(const Frame& frame) const {
  int with = 0, without = 0;
  for (std::size_t k = 0; k < frame.features.size(); ++k) {
    const Feature& feature = frame.features[k];
    if (!feature.stereo() || feature.depth_m > kNearBaselines * camera_.baseline_m) continue;
    ++(frame.points[k] != kNone ? with : without);
  }
  return with < kMinNear && without > kMinNearWithout;
}

bool Tracker::needs_new_keyframe(const Frame& frame, int inliers, bool mapping_idle) const {
  if (frame.number < last_relocalised_ + kFramesBetween) return false;  // (1)
  if (lacks_points(frame)) return true;
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
    placed = follow(frame);
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
