// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/engine.hpp"

#include <algorithm>
#include <cmath>

#include "host/cameras/pair_order.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/slam/bundle.hpp"
#include "host/vision/slam/final_adjustment.hpp"
#include "host/vision/slam/keyframe_covariance.hpp"
#include "host/vision/slam/mapping.hpp"

namespace pharos::slam {
namespace {

constexpr int kMinStart = 60;       // stereo features of a first map
constexpr double kOutOfStep = 0.6;  // delay of right images, frames: simultaneous exposures are far below
constexpr std::size_t kLocalKeyframes = 20;
constexpr int kLocalSteps = 6;
constexpr std::size_t kChainedKeyframes = 40;  // near a new one, from which its covariance is computed
constexpr double kMapping_s = 0.19;            // of a keyframe: 0.2, so that four pairs at 20 Hz are enough
constexpr std::size_t kMaxWaiting = 3;         // keyframes, as in ORB-SLAM2
constexpr std::size_t kMaxKeptImages = 8;      // a loop of a keyframe whose image is gone is measured by corners
constexpr int kGlobalSteps = 12;               // while tracking continues

}  // namespace

Engine::Engine(Rectification rectification, Vocabulary vocabulary, const SlamSettings& settings,
               KeyframeCallback on_keyframe)
    : settings_(settings),
      frontend_(std::move(rectification), settings),
      keyframe_database_(std::move(vocabulary)),
      tracker_(frontend_.camera(), map_, &keyframe_database_),
      closer_(frontend_.camera(), map_, keyframe_database_),
      on_keyframe_(std::move(on_keyframe)) {
  if (!settings_.threads) return;
  closing_.emplace("closing a loop", [this](KeyframeId id) { close_loop(id); });
  mapping_.emplace("mapping a keyframe", [this](KeyframeId id) {
    map_keyframe(id);
    closing_->push(id);
  });
}

void Engine::check_threads() const {
  if (mapping_) mapping_->check();
  if (closing_) closing_->check();
}

void Engine::wait_for_threads() const {
  if (mapping_) mapping_->wait_until_idle();
  if (closing_) closing_->wait_until_idle();
  check_threads();
}

FinalAdjustment Engine::adjust_map(Map& map) const {
  const bool try_steady = settings_.steady_rotation && frontend_.scene() == Scene::kTarget;
  FinalAdjustment solution = adjust_finally(map, frontend_.camera(), try_steady);
  apply_global(solution.problem, solution.rejected, map);
  apply_covariances(solution.covariances, map);
  return solution;
}

std::optional<Spin> Engine::spin_of(const FinalAdjustment& solution) const {
  if (!solution.steady) return std::nullopt;
  const Matrix3& R = frontend_.R_left_rectified();
  std::vector<TrackedFrame> free;
  for (const auto& [id, pose] : solution.free) {
    free.emplace_back();
    free.back().time_s = map_.keyframes.at(id).time_s;
    free.back().placed = in_left_frame({pose, Matrix6::Zero(), 0.0}, R);
  }
  const auto fit = fit_spin(free);
  return fit ? std::optional(steady_spin(R * solution.steady->rate_rad_s, *fit)) : std::nullopt;
}

void Engine::finish() {
  wait_for_threads();
  const std::lock_guard lock(mutex_);
  if (map_.keyframes.size() < 2) return;
  const FinalAdjustment solution = adjust_map(map_);
  steady_ = solution.steady;
  steady_spin_ = spin_of(solution);
}

std::vector<TrackedFrame> Engine::optimised_trajectory() const {
  wait_for_threads();
  const std::lock_guard lock(mutex_);
  Map map = map_;
  const auto steady = map.keyframes.size() < 2 ? std::nullopt : adjust_map(map).steady;
  return log_.frames(map, frontend_.R_left_rectified(), steady ? &*steady : nullptr);
}

// Motion in rows of a frame's points since the frame before, and row difference of left and right.
void Engine::note_skew(const Frame& frame) {
  const auto step = tracker_.step();
  if (!step) return;
  const StereoCamera& camera = frontend_.camera();
  const CameraFromTarget before = step->inverse() * frame.pose;
  for (std::size_t k = 0; k < frame.features.size(); ++k) {
    const MapPoint* point = map_.find_point(frame.points[k]);
    if (point == nullptr || !frame.features[k].stereo()) continue;
    const Vector3 now_m = frame.pose * point->position_m, before_m = before * point->position_m;
    if (!(now_m.z() > 0.0 && before_m.z() > 0.0)) continue;
    skew_.add(camera.project(now_m).y() - camera.project(before_m).y(), frame.features[k].off_row_px);
  }
  skew_.end_frame();
}

KeyframeId Engine::make_keyframe(Frame& frame) {
  const KeyframeId id = map_.add_keyframe(frame, keyframe_database_.words_of(frame.features)).id;
  map_.update_neighbours(id);
  add_stereo_points(map_, id, frontend_.camera());
  add_patches(map_, id, frontend_.pyramid());
  const Keyframe& keyframe = map_.keyframes.at(id);
  for (const PointId point : keyframe.points) {
    if (point != kNone && map_.points.at(point).seen_by.size() == 1) recent_.push_back(point);
  }
  keyframe_database_.add(keyframe);
  if (settings_.close_loops) kept_.emplace(id, frontend_.pyramid());
  if (kept_.size() > kMaxKeptImages) kept_.erase(kept_.begin());
  tracker_.became_keyframe(keyframe);
  last_keyframe_s_ = frame.time_s;
  figures_.add_keyframe();
  return id;
}

TrackedPose Engine::pose_of(const Tracked& tracked) const {
  return {tracked.pose, turned(tracked.pose.R, map_.covariance_of(tracker_.reference())) + tracked.covariance,
          tracked.rms_px};
}

TrackedFrame Engine::place(Frame& frame, const StereoFrontend::Result& seen, KeyframeId& made) {
  TrackedFrame out;
  out.number = frame.number;
  out.time_s = frame.time_s;
  out.features = static_cast<int>(frame.features.size());
  const std::lock_guard lock(mutex_);
  steady_.reset();
  steady_spin_.reset();
  Matrix6 own = Matrix6::Zero();
  if (map_.keyframes.empty()) {
    if (seen.stats.matched >= kMinStart) {
      frame.points.assign(frame.features.size(), kNone);
      made = make_keyframe(frame);
      frontend_.keep_scene();
      out.placed = TrackedPose{frame.pose, Matrix6::Zero()};
    }
  } else {
    // Without threads mapping takes no time; it counts as busy for the time it would take.
    const bool idle = mapping_ ? mapping_->idle() : frame.time_s >= last_keyframe_s_ + kMapping_s;
    const Tracked tracked = tracker_.track(frame, idle, frontend_.pyramid());
    out.inliers = tracked.inliers;
    out.relocalised = tracked.relocalised;
    out.lost = tracked.state == TrackState::kLost;
    out.ambiguous_place = tracked.ambiguous_place;
    if (!out.lost) {
      out.placed = pose_of(tracked);
      own = tracked.covariance;
      note_skew(frame);
    }
    // With this many waiting keyframes, mapping would be delayed more and more.
    const bool behind = mapping_ && mapping_->waiting() >= kMaxWaiting;
    if (tracked.wants_keyframe && !behind) {
      made = make_keyframe(frame);
      map_.keyframes.at(made).covariance = turned(tracked.pose.R.transpose(), out.placed->covariance);
    }
  }
  out.keyframe = made != kNone;
  const Pose<frame::Camera, frame::Camera> relative =
      out.placed ? frame.pose * map_.pose_of(tracker_.reference()).inverse() : Pose<frame::Camera, frame::Camera>{};
  if (settings_.keep_trajectory) log_.add(out, tracker_.reference(), relative, own);
  return out;
}

TrackedFrame Engine::push(double time_s, ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) {
  check_threads();
  const StereoCamera& camera = frontend_.camera();
  if (left.width_px != camera.width_px || left.height_px != camera.height_px || !left.same_size(right)) {
    throw host::InputError("a pair of " + std::to_string(left.width_px) + " x " + std::to_string(left.height_px) +
                           " and " + std::to_string(right.width_px) + " x " + std::to_string(right.height_px) +
                           " pixels; the rig's cameras have " + std::to_string(camera.width_px) + " x " +
                           std::to_string(camera.height_px));
  }
  const Stopwatch on_keyframe;
  StereoFrontend::Result seen = frontend_.push(left, right, !order_.known());
  order_.add(seen.features.size(), seen.stats);
  Frame frame;
  frame.number = figures_.frames();
  frame.time_s = time_s;
  frame.features = std::move(seen.features);
  frame.grid = FeatureGrid(frame.features, camera.width_px, camera.height_px);
  KeyframeId made = kNone;
  TrackedFrame out = place(frame, seen, made);
  {
    const std::lock_guard lock(mutex_);
    figures_.add_frame(out, seen, on_keyframe.ms());
  }
  if (made != kNone && mapping_) mapping_->push(made);
  if (made != kNone && !mapping_) {
    map_keyframe(made);
    close_loop(made);
  }
  if (out.placed) out.placed = in_left_frame(*out.placed, frontend_.R_left_rectified());
  last_ = std::move(frame);
  if (const auto late = skew_.frames_late(); late && std::abs(*late) > kOutOfStep) {
    throw host::NoPairError("left and right images are out of step: the right ones are " +
                            std::string(*late > 0.0 ? "late" : "early") + " by about " +
                            std::to_string(std::max(1L, std::lround(std::abs(*late)))) + " frame(s)");
  }
  return out;
}

void Engine::map_keyframe(KeyframeId id) {
  if (on_keyframe_) on_keyframe_(id);
  const Stopwatch on_keyframe;
  BundleProblem problem;
  std::int64_t corrections = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!map_.keyframes.contains(id)) return;
    cull_points(map_, recent_);
    triangulate(map_, id, frontend_.camera());
    for (const PointId point : map_.keyframes.at(id).points) {
      if (point != kNone && map_.points.at(point).created_at == id && map_.points.at(point).seen_by.size() == 2) {
        recent_.push_back(point);
      }
    }
    fuse_with_neighbours(map_, id, frontend_.camera());
    problem = local_problem(map_, id, kLocalKeyframes);
    corrections = corrections_;
  }
  const std::vector<std::size_t> rejected = adjust_bundle(problem, frontend_.camera(), kLocalSteps);
  const auto about = keyframe_covariances(problem, rejected, frontend_.camera(), id, kChainedKeyframes);
  const std::lock_guard lock(mutex_);
  // A loop closed meanwhile moved the poses that this solution started from.
  if (corrections == corrections_) apply(problem, rejected, map_);
  if (map_.keyframes.contains(id)) {
    chain_covariance(map_, id, about);
    cull_keyframes(map_, id, &keyframe_database_, settings_.max_keyframes);
  }
  if (!settings_.keep_trajectory) map_.forget_removed(tracker_.reference());
  figures_.add_mapping(on_keyframe.ms());
}

ClosedLoop Engine::in_left_camera(const Loop& loop) const {
  const Keyframe& there = map_.keyframes.at(loop.there);
  const Pose<frame::Camera, frame::Camera> measured = loop.corrected * there.pose.inverse();
  const Matrix3& R = frontend_.R_left_rectified();
  return {map_.keyframes.at(loop.here).number, there.number, {R * measured.R * R.transpose(), R * measured.t}};
}

PyramidCopy Engine::take_image(KeyframeId id) {
  const auto at = kept_.find(id);
  if (at == kept_.end()) return {};
  PyramidCopy out = std::move(at->second);
  kept_.erase(at);
  return out;
}

void Engine::close_loop(KeyframeId id) {
  if (!settings_.close_loops) return;
  const Stopwatch on_keyframe;
  BundleProblem problem;
  KeyframeId first = kNone;
  {
    const std::lock_guard lock(mutex_);
    const PyramidCopy image = take_image(id);
    const LoopDecision decision = closer_.decide(id, image.levels());
    figures_.set_loops_refused(closer_.refused(), closer_.counts());
    if (decision.taken_back) {
      loops_.push_back(in_left_camera(*decision.taken_back));
      loops_.back().taken_back = true;
    }
    if (!decision.close) return;
    loops_.push_back(in_left_camera(*decision.close));
    closer_.correct(*decision.close);
    ++corrections_;
    problem = global_problem(map_);
    first = map_.keyframes.begin()->first;
  }
  const std::vector<std::size_t> rejected = adjust_bundle(problem, frontend_.camera(), kGlobalSteps);
  const auto covariances = keyframe_covariances(problem, rejected, frontend_.camera(), first);
  const std::lock_guard lock(mutex_);
  apply_global(problem, rejected, map_);
  apply_covariances(covariances, map_);
  ++corrections_;
  figures_.add_loop(on_keyframe.ms());
}

std::vector<TrackedFrame> Engine::trajectory() const {
  const std::lock_guard lock(mutex_);
  return log_.frames(map_, frontend_.R_left_rectified(), steady_ ? &*steady_ : nullptr);
}

std::optional<Spin> Engine::spin() const {
  {
    const std::lock_guard lock(mutex_);
    if (steady_) return steady_spin_;
  }
  return fit_spin(trajectory());
}

std::vector<SlamPoint> Engine::points() const {
  const std::lock_guard lock(mutex_);
  std::vector<SlamPoint> out;
  for (const auto& [id, point] : map_.points) {
    out.push_back({frontend_.R_left_rectified() * point.position_m, static_cast<int>(point.seen_by.size())});
  }
  return out;
}

std::vector<ClosedLoop> Engine::loops() const {
  const std::lock_guard lock(mutex_);
  return loops_;
}

SlamReport Engine::report() const {
  const std::lock_guard lock(mutex_);
  SlamReport out = figures_.report();
  out.keyframes = static_cast<int>(map_.keyframes.size());
  out.points = static_cast<int>(map_.points.size());
  out.scene = frontend_.scene();
  out.steady_rotation = steady_.has_value();
  return out;
}

std::vector<std::array<double, 3>> Engine::last_features() const {
  std::vector<std::array<double, 3>> out;
  for (std::size_t k = 0; k < last_.features.size(); ++k) {
    const Feature& feature = last_.features[k];
    const bool known = k < last_.points.size() && last_.points[k] != kNone;
    out.push_back({feature.pixel.x(), feature.pixel.y(), known ? 2.0 : feature.stereo() ? 1.0 : 0.0});
  }
  return out;
}

}  // namespace pharos::slam
