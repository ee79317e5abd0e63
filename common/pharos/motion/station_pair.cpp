// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/station_pair.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/motion/mahalanobis.hpp"

namespace pharos::motion {
namespace {

// Half a second of sweeps and sigmas this small before a track determines the other station's pose.
constexpr int kSettledSweeps = 60;
constexpr double kSettledRotation_rad = 0.035, kSettledPosition_m = 0.03;
// Initial sigmas of a relative pose determined by two tracks, for the second station's sweeps to correct: as at a start
// from one cycle.
constexpr double kLooseRotation_rad = 0.06, kLoosePosition_m = 0.1;
// A track that saw the body this recently is current.
constexpr double kFreshPair_s = 0.03;
// Squared distance (6 degrees of freedom) from which two poses contradict each other, and the number of consecutive
// sweeps for a decision.
constexpr double kPairContradiction = 40.0;
constexpr int kContradictions = 30;
// A joint hypothesis with larger sigmas than these is discarded.
constexpr double kLostPairRotation_rad = 0.7, kLostPairPosition_m = 1.0;
constexpr double kLost_s = 0.5;

double rotation_variance(const Matrix6& covariance) { return covariance.topLeftCorner<3, 3>().trace(); }
double position_variance(const Matrix6& covariance) { return covariance.bottomRightCorner<3, 3>().trace(); }

bool settled(const StationTrack& track) {
  const Hypothesis* best = track.best();
  if (best == nullptr || track.has_alternative() || best->sweeps() < kSettledSweeps ||
      best->consecutive_rejections() > 0)
    return false;
  const Matrix6& covariance = best->state_estimate().covariance;
  return rotation_variance(covariance) < kSettledRotation_rad * kSettledRotation_rad &&
         position_variance(covariance) < kSettledPosition_m * kSettledPosition_m;
}

bool settled_together(const StationPair::Tracks& tracks) {
  if (!settled(*tracks[0]) || !settled(*tracks[1])) return false;
  // A relative pose that takes a wrong tilt over explains it to the joint hypothesis.
  if (tracks[0]->best()->tilt_is_loose() || tracks[1]->best()->tilt_is_loose()) return false;
  const std::int64_t apart = tracks[0]->best()->last_used_ticks() - tracks[1]->best()->last_used_ticks();
  return std::abs(ticks_to_seconds(apart)) < kFreshPair_s;
}

std::int64_t now_of(const StationPair::Tracks& tracks) {
  return std::max(tracks[0]->best()->time_ticks(), tracks[1]->best()->time_ticks());
}

}  // namespace

void StationPair::survey(const std::optional<StationRelative>& relative) {
  std::optional<Known> surveyed;
  if (relative) {
    const StationRelative other = relative->seen_from_the_other();
    surveyed = {other.T_0_1, other.covariance};
  }
  if (surveyed == surveyed_) return;
  lose();
  learnt_.reset();
  surveyed_ = surveyed;
  survey_refused_ = false;
}

void StationPair::lose() {
  joint_.reset();
  without_.reset();
  doubt_.end();
  contradictions_ = {};
}

void StationPair::forget_learnt() {
  lose();
  learnt_.reset();
}

std::optional<StationRelative> StationPair::relative() const {
  if (!joint_) return std::nullopt;
  const SecondStation& second = joint_->filter().second();
  return StationRelative{second.pose, second.ss}.seen_from_the_other();
}

void StationPair::push(const lighthouse::SweepBearings& bearings, Axis axis, std::uint8_t station, const Tracks& tracks,
                       const StationView& view, const AssumedNoise& noise) {
  if (!joint_) {
    start(tracks);
    return;
  }
  const std::int64_t now = last_hit_ticks(bearings, *view.target);
  if (ticks_to_seconds(now - joint_->last_used_ticks()) > kLost_s) {
    remember();
    lose();
    return;
  }
  take(bearings, axis, observer_of(station), view, noise);
  const Matrix6& covariance = joint_->state_estimate().covariance;
  if (!(rotation_variance(covariance) < kLostPairRotation_rad * kLostPairRotation_rad) ||
      !(position_variance(covariance) < kLostPairPosition_m * kLostPairPosition_m)) {
    remember();
    lose();
    return;
  }
  watch(station, tracks);
}

void StationPair::take(const lighthouse::SweepBearings& bearings, Axis axis, Observer observer, const StationView& view,
                       const AssumedNoise& noise) {
  joint_->push(bearings, axis, view, noise, observer, &without_);
  if (!without_) return;
  if (without_->sweeps() == joint_->sweeps()) {
    doubt_.begin(*joint_, kMaxStations);
    return;
  }
  without_->push(bearings, axis, view, noise, observer);
  doubt_.judge(joint_, without_);
}

// Squared distance of the present estimates of both tracks, by way of the relative pose.
double StationPair::apart_square(const Known& known, const Tracks& tracks) const {
  const std::int64_t now = now_of(tracks);
  const StateEstimate first = tracks[0]->best()->predicted(now), second = tracks[1]->best()->predicted(now);
  const SecondView view(first.pose, known.T_1_0);
  const Matrix6 allowed = seen_covariance(view, first.covariance, {known.T_1_0, known.covariance}) + second.covariance;
  return mahalanobis_squared(second.pose, view.pose, allowed);
}

bool StationPair::contradicted(std::uint8_t station, const Tracks& tracks) const {
  const Hypothesis *own = tracks[station]->best(), *other = tracks[1U - station]->best();
  if (!surveyed_ || survey_refused_ || own == nullptr || other == nullptr || !other->confirmed() || other->diverged())
    return false;
  if (std::abs(ticks_to_seconds(own->time_ticks() - other->last_used_ticks())) > kFreshPair_s) return false;
  const Matrix6 &of_own = own->state_estimate().covariance, &of_other = other->state_estimate().covariance;
  return rotation_variance(of_other) < rotation_variance(of_own) &&
         position_variance(of_other) < position_variance(of_own) &&
         !(apart_square(*surveyed_, tracks) < kPairContradiction);
}

const StationPair::Known* StationPair::known() const {
  if (surveyed_ && !survey_refused_) return &*surveyed_;
  return learnt_ ? &*learnt_ : nullptr;
}

void StationPair::start(const Tracks& tracks) {
  const bool together = settled_together(tracks);
  if (const Known* there = known();
      there != nullptr && together && !(apart_square(*there, tracks) < kPairContradiction)) {
    if (++contradictions_[0] < kContradictions) return;
    contradictions_ = {};
    ++refusals_;
    if (there == &*surveyed_) survey_refused_ = true;
    learnt_.reset();
  }
  if (const Known* there = known(); there != nullptr) {
    if (!settled(*tracks[0])) return;
    joint_ = *tracks[0]->best();
    joint_->link(there->T_1_0, there->covariance, surveyed_ && there == &*surveyed_);
  } else if (together) {
    start_from_both(tracks);
  }
  contradictions_ = {};
}

void StationPair::start_from_both(const Tracks& tracks) {
  const std::int64_t now = now_of(tracks);
  const LighthouseFromBody first = tracks[0]->best()->predicted(now).pose;
  const LighthouseFromBody second = tracks[1]->best()->predicted(now).pose;
  const StationFromStation T_1_0 = second * first.inverse();
  // The same sigmas for the pose as the second station sees it.
  Matrix6 seen = Matrix6::Zero();
  seen.diagonal().head<3>().setConstant(kLooseRotation_rad * kLooseRotation_rad);
  seen.diagonal().tail<3>().setConstant(kLoosePosition_m * kLoosePosition_m);
  Matrix6 back = SecondView(first, T_1_0).by_second;
  back.bottomLeftCorner<3, 3>() *= -1.0;  // its inverse
  joint_ = *tracks[0]->best();
  joint_->link(T_1_0, back.lazyProduct(Matrix6(seen.lazyProduct(back.transpose()))), false);
}

// Compares a station's own track with the joint hypothesis. Which of them is wrong, and whether the relative pose is,
// is decided when the next joint hypothesis is to begin.
void StationPair::watch(std::uint8_t station, const Tracks& tracks) {
  int& contradictions = contradictions_[station];
  bool apart = false;
  if (settled(*tracks[station])) {
    const StateEstimate own = tracks[station]->best()->predicted(joint_->time_ticks());
    const StateEstimate& state_estimate = joint_->state_estimate();
    apart = mahalanobis_squared(own.pose, state_estimate.pose, state_estimate.covariance + own.covariance) >
            kPairContradiction;
  }
  contradictions = apart ? contradictions + 1 : 0;
  if (contradictions < kContradictions) return;
  remember();
  lose();
}

void StationPair::remember() {
  const SecondStation& second = joint_->filter().second();
  learnt_ = {second.pose, second.ss};
}

}  // namespace pharos::motion
