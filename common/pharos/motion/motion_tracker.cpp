// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/motion_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/pose/covariance.hpp"

namespace pharos::motion {
namespace {

// Four times what sensors of a target built from its drawing are out of their places.
constexpr double kMaxNoise_m = 1.5e-3;
// Of so few hits a sweep's shape says next to nothing of a tilt.
constexpr std::size_t kFewSensors = 4;

std::uint8_t flags_of(const lighthouse::Sweep& sweep, bool calibrated) {
  std::uint8_t flags = 0;
  if (!calibrated) flags |= track::kEpochUncalibrated;
  if (sweep.flags & lighthouse::kSweepFlashWeak) flags |= track::kEpochFlashWeak;
  if (sweep.flags & lighthouse::kSweepPeriodNominal) flags |= track::kEpochPeriodNominal;
  if (sweep.flags & lighthouse::kSweepLockPoor) flags |= track::kEpochLockPoor;
  return flags;
}

std::int64_t last_used_hit(const lighthouse::SweepBearings& bearings, const HitFits& used) {
  std::int64_t last = INT64_MIN;
  for (const HitFit& hit : used) last = std::max(last, bearings[hit.bearing].time_ticks);
  return last;
}

bool answers(const Hypothesis& hypothesis) { return !hypothesis.last_fit().used.empty() && !hypothesis.diverged(); }

double residual_rms(const HitFits& used, const Vector6& shift) {
  double square = 0.0;
  for (const HitFit& hit : used) {
    const double left = hit.residual_rad - hit.jacobian.dot(shift);
    square += left * left;
  }
  return std::sqrt(square / static_cast<double>(used.size()));
}

}  // namespace

MotionOptions motion_options(const track::TrackOptions& same, const SystematicErrors& systematic,
                             const UncertaintyLimits& limits) {
  MotionOptions options;
  options.solve = same.solve;
  options.form = same.form;
  options.smooth_flashes = same.smooth_flashes;
  if (same.solve.rho > 0.0) options.rho = same.solve.rho;
  options.systematic = systematic;
  options.limits = limits;
  return options;
}

MotionTracker::MotionTracker(const Target& target, const MotionOptions& options) : target_(target), options_(options) {}

void MotionTracker::set_calibration(std::uint8_t station, const lighthouse::StationCalibration& calibration,
                                    lighthouse::CalibrationSource source) {
  if (station >= kMaxStations) return;
  Station& s = stations_[station];
  s.source = source;
  if (s.calibration == calibration) return;
  // Another calibration changes every angle: the present state no longer holds.
  s.track.lose();
  pair_.forget_learnt();
  s.calibration = calibration;
}

void MotionTracker::clear_calibration(std::uint8_t station) {
  if (station >= kMaxStations || !stations_[station].calibration) return;
  stations_[station] = {};
  pair_.forget_learnt();
}

void MotionTracker::set_relative(const std::optional<StationRelative>& relative) { pair_.survey(relative); }

void MotionTracker::forget_stations() {
  stations_ = {};
  pair_ = {};
  contradictions_ = {};
}

StationView MotionTracker::view_of(const Station& station) const {
  return {&target_, station.calibration ? &*station.calibration : nullptr, options_.form};
}

AssumedNoise MotionTracker::noise_of(const Station& station) const {
  AssumedNoise noise{options_.solve.sigma_rad, options_.rho, options_.systematic};
  if (station.source == lighthouse::CalibrationSource::kSent) {
    noise.systematic.rotor_rad = std::max(noise.systematic.rotor_rad, kUncalibratedErrors.rotor_rad);
  }
  return noise;
}

std::optional<track::EpochResult> MotionTracker::push(const lighthouse::Sweep& sweep) {
  if (sweep.flash.station >= kMaxStations) return std::nullopt;
  Station& station = stations_[sweep.flash.station];
  const Axis axis = sweep.flash.axis;
  if (!station.gate[static_cast<std::size_t>(index_of(axis))].fits(sweep)) {
    return refused_as_mistimed(sweep);
  }
  const lighthouse::SmoothedFlash smoothed = station.smoother[static_cast<std::size_t>(index_of(axis))].push(sweep);
  if (sweep.flash.skip) return std::nullopt;
  const lighthouse::SweepBearings bearings =
      options_.smooth_flashes ? lighthouse::bearings_of(sweep, smoothed) : lighthouse::bearings_of(sweep);

  const Hypothesis* best = station.track.best();
  if (best != nullptr && ticks_to_seconds(sweep.flash.start_ticks - best->last_used_ticks()) > kLost_s) {
    station.track.lose();
  }
  const bool lit = last_hit_ticks(bearings, target_) != INT64_MIN;
  if (lit) {
    station.track.push(bearings, axis, view_of(station), noise_of(station));
    pair_.push(bearings, axis, sweep.flash.station, tracks(), view_of(station), noise_of(station));
    assess(station);
  }
  const auto check = [&](const track::Cycle* cycle) {
    if (cycle != nullptr) station.track.check(*cycle, view_of(station), noise_of(station), options_.solve);
  };
  const track::Cycle* closed = station.assembler.close_before(axis, sweep.flash.start_ticks);
  check(closed);
  check(station.assembler.add(sweep.flash.station, axis, sweep.flash.start_ticks, sweep.flags, bearings,
                              closed == nullptr));
  if (bearings.empty()) return std::nullopt;
  return answer(station, sweep, bearings);
}

// What the last sweep of a station says of the target.
void MotionTracker::assess(const Station& station) {
  const Hypothesis* own = station.track.best();
  if (own == nullptr) return;
  const double dispute = own->noise_implausible() ? 1.0 : own->dispute();
  if (dispute > 0.0) {
    contradictions_.add(dispute);
  } else if (own->agreements() > 0) {
    contradictions_.agree();
  }
}

// The hypothesis that took this sweep and has the smaller covariance: the station's own or the joint one.
const Hypothesis* MotionTracker::better_of(const Station& station, std::uint8_t slot, std::int64_t time_ticks) const {
  const Hypothesis* own = station.track.best();
  const Hypothesis* joint = pair_.joint();
  // A hypothesis that has just begun from an older cycle has not taken this sweep.
  if (own != nullptr && own->time_ticks() < time_ticks) own = nullptr;
  if (joint == nullptr || joint->time_ticks() < time_ticks || !answers(*joint) ||
      joint->observer() != observer_of(slot)) {
    return own;
  }
  if (own == nullptr || !answers(*own)) return joint;
  const Matrix6 &of_own = own->state_estimate().covariance, &of_joint = joint->state_estimate().covariance;
  const bool knows_more = of_joint.topLeftCorner<3, 3>().trace() <= of_own.topLeftCorner<3, 3>().trace() &&
                          of_joint.bottomRightCorner<3, 3>().trace() <= of_own.bottomRightCorner<3, 3>().trace();
  return knows_more ? joint : own;
}

track::EpochResult MotionTracker::answer(Station& station, const lighthouse::Sweep& sweep,
                                         const lighthouse::SweepBearings& bearings) {
  track::EpochResult result;
  result.station = sweep.flash.station;
  result.flags = flags_of(sweep, station.calibration.has_value());
  result.time_ticks = last_hit_ticks(bearings, target_);
  result.observations = static_cast<int>(bearings.size());
  innovation_ = {};
  if (result.time_ticks == INT64_MIN) {
    for (const lighthouse::Bearing& bearing : bearings)
      result.time_ticks = std::max(result.time_ticks, bearing.time_ticks);
    result.pose = pose::Refusal::kUnknownSensors;
    keep_bearings(bearings, sweep.flash.axis, nullptr);
    return result;
  }
  const Hypothesis* best = better_of(station, result.station, result.time_ticks);
  keep_bearings(bearings, sweep.flash.axis, best != nullptr ? &best->last_fit() : nullptr);
  if (best == nullptr) {
    result.pose = station.track.last_refusal() == pose::Refusal::kNone ? pose::Refusal::kTooFewSensors
                                                                       : station.track.last_refusal();
    return result;
  }
  if (best == pair_.joint()) result.flags |= track::kEpochFused;
  const SweepInformation& information = best->last_fit().information;
  innovation_ = {best->nis(), information.rank, information.residual_chi2, information.hits - information.rank};
  result.pose = estimate(station, *best, bearings, result);
  return result;
}

Result<LighthousePoseEstimate, pose::Refusal> MotionTracker::estimate(const Station& station, const Hypothesis& best,
                                                                      const lighthouse::SweepBearings& bearings,
                                                                      track::EpochResult& result) const {
  const SweepFit& fit = best.last_fit();
  const Observer observer = best.observer();
  if (static_cast<int>(fit.used.size()) < fit.candidates) result.flags |= track::kEpochOutliers;
  if (best.noise_scale(observer) > kNoisy) result.flags |= track::kEpochResidualHigh;
  if (!answers(best)) return pose::Refusal::kPoorFit;
  if (contradictions_.suspect()) return pose::Refusal::kSuspectTarget;
  if (!trusted(station, best)) return pose::Refusal::kUnconfirmed;
  if (&best != pair_.joint() && pair_.contradicted(result.station, tracks())) return pose::Refusal::kUnconfirmed;
  result.observations = static_cast<int>(fit.used.size());
  result.time_ticks = last_used_hit(bearings, fit.used);

  const StateEstimate state_estimate = best.predicted(result.time_ticks, observer);
  LighthousePoseEstimate e;
  e.time_ns = ticks_to_nanoseconds(result.time_ticks);
  e.pose = state_estimate.pose;
  e.pose.R = orthonormalised(state_estimate.pose.R);
  e.covariance = state_estimate.covariance;
  if (!station.calibration) {
    const auto unknown = best.cycle_information(observer).covariance_of(options_.unknown_station);
    if (!unknown) return pose::Refusal::kTooUncertain;
    e.covariance += *unknown;
  } else {
    e.covariance += best.second_order();
  }
  e.observations = result.observations;
  e.iterations = 1;
  e.residual_rms = residual_rms(fit.used, pose_difference(best.state_estimate().pose, fit.pose));
  if (best.cycle_information(observer).known()) {
    const Matrix6 unit =
        best.cycle_information(observer).variances_of(1.0 - options_.solve.rho, options_.solve.rho).asDiagonal();
    e.adop_deg_per_rad = pose::adop_of(unit);
    e.pdop_m_per_rad = pose::pdop_of(unit);
  } else {
    result.flags |= track::kEpochPrior;
  }
  if (!e.pose.is_finite() || !e.covariance.allFinite()) return pose::Refusal::kNotConverged;
  if (best.tilt_unknown()) return pose::Refusal::kTooUncertain;
  if (e.sigma_rotation_rad() > options_.limits.rotation_rad || e.sigma_position_m() > options_.limits.position_m) {
    return pose::Refusal::kTooUncertain;
  }
  if (const Hypothesis* alternative = station.track.alternative(); alternative != nullptr && &best != pair_.joint()) {
    const double delta = station.track.delta_chi2();
    if (delta < kAmbiguousDeltaChi2) e.second = {alternative->state_estimate().pose, std::max(0.0, delta)};
  }
  return e;
}

// After sweeps that speak against the target a state must be confirmed by sweeps in a row. Where the hits of a
// calibrated station are as noisy as if sensors were far from their places, the state is that of another body or
// attitude.
bool MotionTracker::trusted(const Station& station, const Hypothesis& best) const {
  if (!best.confirmed() || best.undisputed() < contradictions_.needed()) return false;
  if (contradictions_.disputed() && best.last_fit().used.size() <= kFewSensors) return false;
  const double own_rad = best.noise_scale(best.observer()) * options_.solve.sigma_rad * std::sqrt(1.0 - options_.rho);
  return !station.calibration || own_rad * best.state_estimate().pose.t.norm() < kMaxNoise_m;
}

std::optional<track::EpochResult> MotionTracker::refused_as_mistimed(const lighthouse::Sweep& sweep) {
  ++mistimed_;
  contradictions_.add(1.0);
  if (sweep.hits.empty()) return std::nullopt;
  track::EpochResult result;
  result.station = sweep.flash.station;
  result.time_ticks = sweep.flash.start_ticks;
  result.observations = static_cast<int>(sweep.hits.size());
  result.pose = pose::Refusal::kSuspectTarget;
  innovation_ = {};
  bearings_.clear();
  return result;
}

void MotionTracker::keep_bearings(const lighthouse::SweepBearings& bearings, Axis axis, const SweepFit* fit) {
  bearings_.clear();
  for (const lighthouse::Bearing& bearing : bearings)
    bearings_.push_back({bearing, axis, bearing.theta_rad, false, 0.0});
  if (fit == nullptr) return;
  for (const HitFit& hit : fit->used) {
    track::TrackedBearing& kept = bearings_[hit.bearing];
    kept.used = true;
    kept.ideal_theta_rad = hit.ideal_rad;
    kept.residual_rad = hit.residual_rad;
  }
}

std::optional<StateEstimate> MotionTracker::predicted(std::uint8_t station, std::int64_t time_ticks) const {
  if (station >= kMaxStations) return std::nullopt;
  const auto alive = [&](const Hypothesis* h) {
    return h != nullptr && ticks_to_seconds(time_ticks - h->last_used_ticks()) <= kLost_s;
  };
  if (const Hypothesis* joint = pair_.joint(); alive(joint)) return joint->predicted(time_ticks, observer_of(station));
  const Hypothesis* best = stations_[station].track.best();
  return alive(best) ? std::optional(best->predicted(time_ticks)) : std::nullopt;
}

}  // namespace pharos::motion
