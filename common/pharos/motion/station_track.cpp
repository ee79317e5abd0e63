// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/station_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pharos/base/ticks.hpp"
#include "pharos/motion/mahalanobis.hpp"
#include "pharos/track/ideal_observations.hpp"

namespace pharos::motion {
namespace {

constexpr int kCheckCycles = 16;  // about a quarter of a second between checks of a track without contradictions
// While a track is young or its hits are noisier than assumed (kNoisy), it may have started from a false hit.
constexpr int kCheckCyclesUnconfirmed = 2;
constexpr int kMinConfirmedSweeps = 32;
constexpr int kMaxConsecutiveRejections = 2;  // sweeps that contradict a track; one makes a check due at once
// Sweeps that an alternative started in flight needs to estimate its rates before it is compared.
constexpr int kSettleSweeps = 6;
// Squared distance (6 degrees of freedom) from which a solved cycle contradicts the track.
constexpr double kContradiction = 40.0;
// A track with larger sigmas than these is discarded.
constexpr double kLostTrackRotation_rad = 0.7, kLostTrackPosition_m = 1.0;
// Two solved cycles further apart than this determine no rate.
constexpr double kLongestBetween_s = 0.07;
// Time over which a cycle's hits are spread, for the effect of motion on its solution.
constexpr double kCycle_s = 0.01;

// No sensor has this number.
constexpr std::uint8_t kNoSensor = 255;

// The cycle in which bearings that the solution left out are assigned to no sensor, their order kept.
track::Cycle estimate_part(const track::Cycle& cycle, const track::IdealObservations& ideal,
                           const pose::Solution& solution) {
  track::Cycle part = cycle;
  const auto was_used = [&](Axis axis, const lighthouse::Bearing& bearing) {
    for (std::size_t i = 0; i < ideal.observations.size(); ++i) {
      if (solution.used[i] && ideal.observations[i].axis == axis && ideal.raw[i].sensor == bearing.sensor &&
          ideal.raw[i].time_ticks == bearing.time_ticks) {
        return true;
      }
    }
    return false;
  };
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (lighthouse::Bearing& bearing : part.bearings[static_cast<std::size_t>(index_of(axis))]) {
      if (!was_used(axis, bearing)) bearing.sensor = kNoSensor;
    }
  }
  return part;
}

}  // namespace

void StationTrack::lose() {
  best_.reset();
  drop_alternative();
  mirrored_.reset();
  refusal_ = pose::Refusal::kTooFewSensors;
}

void StationTrack::drop_alternative() {
  alternative_.reset();
  doubt_.end();
}

void StationTrack::push(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                        const AssumedNoise& noise) {
  if (!best_) return;
  const bool may_doubt = !alternative_ || doubt_.open();
  best_->push(bearings, axis, view, noise, Observer::kReference, may_doubt ? &alternative_ : nullptr);
  const Matrix6& covariance = best_->state_estimate().covariance;
  if (!(covariance.topLeftCorner<3, 3>().trace() < kLostTrackRotation_rad * kLostTrackRotation_rad) ||
      !(covariance.bottomRightCorner<3, 3>().trace() < kLostTrackPosition_m * kLostTrackPosition_m)) {
    lose();
    return;
  }
  // The errors of an unknown station are larger than what perspective tells.
  if (view.calibration != nullptr && mirrored_.push(*best_, bearings, axis, view, noise, !doubt_.open())) {
    drop_alternative();
  }
  if (!alternative_) return;
  // An alternative of an earlier doubt has not counted this sweep yet: this is a new one, in its place, as a body that
  // is steady again has borne the earlier doubt out.
  if (may_doubt && alternative_->sweeps() == best_->sweeps()) {
    doubt_.begin(*best_, 1);
    alternative_settled_ = false;
    return;
  }
  alternative_->push(bearings, axis, view, noise);
  decide();
}

void StationTrack::decide() {
  if (doubt_.open()) {
    if (doubt_.judge(best_, alternative_)) mirrored_.renew();
    return;
  }
  if (!alternative_settled_) {
    if (alternative_->sweeps() < kSettleSweeps) return;
    alternative_settled_ = true;
    best_->reset_cost();
    alternative_->reset_cost();
    return;
  }
  if (alternative_->cost() < best_->cost()) {
    take_over(best_, alternative_);
    mirrored_.renew();
  }
  if (alternative_chi2() > kDecided || same_pose(*best_, *alternative_)) drop_alternative();
}

bool StationTrack::due() const {
  if (!best_) return true;
  if (best_->consecutive_rejections() >= kMaxConsecutiveRejections) return true;
  if (alternative_) return false;
  const bool unconfirmed = best_->sweeps() < kMinConfirmedSweeps || best_->noise_scale() > kNoisy;
  return best_->consecutive_rejections() > 0 ||
         cycles_unchecked_ >= (unconfirmed ? kCheckCyclesUnconfirmed : kCheckCycles);
}

bool StationTrack::agrees(const LighthouseFromBody& pose, const Matrix6& covariance) const {
  const StateEstimate& state_estimate = best_->state_estimate();
  Matrix6 allowed = state_estimate.covariance + covariance;
  const double turned = state_estimate.rate.head<3>().norm() * kCycle_s,
               moved = state_estimate.rate.tail<3>().norm() * kCycle_s;
  for (int k = 0; k < 3; ++k) {
    allowed(k, k) += turned * turned;
    allowed(k + 3, k + 3) += moved * moved;
  }
  return mahalanobis_squared(pose, state_estimate.pose, allowed) < kContradiction;
}

void StationTrack::check(const track::Cycle& cycle, const StationView& view, const AssumedNoise& noise,
                         const pose::SolveOptions& options) {
  ++cycles_unchecked_;
  if (!due()) return;
  track::IdealObservations ideal = ideal_observations(cycle, *view.target, view.calibration, view.form, nullptr);
  auto solution = pose::solve(*view.target, ideal.observations, options);
  if (solution && ideal.guessed) {
    const LighthouseFromBody first = solution->estimate.pose;
    ideal = ideal_observations(cycle, *view.target, view.calibration, view.form, &first);
    solution = pose::solve(*view.target, ideal.observations, options);
  }
  refusal_ = solution ? pose::Refusal::kNone : solution.error();
  if (!solution) return;
  cycles_unchecked_ = 0;
  const LighthousePoseEstimate& e = solution->estimate;
  // Residual of the fit, motion within the cycle included, over the noise assumed: the hits' own where that is too
  // small.
  const int freedom = std::max(1, e.observations - 6);
  const double own_sigma = noise.sigma_rad * std::sqrt(1.0 - noise.rho);
  const double left = e.residual_rms * std::sqrt(static_cast<double>(e.observations) / freedom);
  const double noise_scale = std::max(1.0, left / own_sigma);
  // Two solutions in a row, as long as the track is contradicted, also give its rate.
  Vector6 between;
  const Vector6* rate = nullptr;
  const double since_s = ticks_to_seconds(cycle.last_flash_ticks - solved_flash_ticks_);
  if (solved_ && since_s > 0.0 && since_s < kLongestBetween_s) {
    between = pose_difference(e.pose, *solved_) / since_s;
    rate = &between;
  }
  solved_.reset();
  if (!e.second) {
    solved_ = e.pose;
    solved_flash_ticks_ = cycle.last_flash_ticks;
  }
  const track::Cycle believed = estimate_part(cycle, ideal, *solution);
  const auto begin = [&](std::optional<Hypothesis>& hypothesis, const LighthouseFromBody& pose) {
    hypothesis.emplace(believed, pose, rate, noise_scale, view, noise);
  };
  // Where sweep after sweep contradicts the track while a whole cycle can be solved, the track is dropped.
  if (!best_ || best_->consecutive_rejections() >= kMaxConsecutiveRejections) {
    begin(best_, e.pose);
    drop_alternative();
    mirrored_.reset();
    if (!e.second) return;
    begin(alternative_, e.second->pose);
    if (view.calibration != nullptr && best_->sees_tilt()) {
      mirrored_.begin(*alternative_);
      drop_alternative();
      return;
    }
    alternative_settled_ = true;
    decide();
    return;
  }
  if (agrees(e.pose, e.covariance) || (e.second && agrees(e.second->pose, e.covariance))) return;
  begin(alternative_, e.pose);
  alternative_settled_ = false;
}

}  // namespace pharos::motion
