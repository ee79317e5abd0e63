// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/motion/mahalanobis.hpp"

namespace pharos::motion {
namespace {

// Error of a single-cycle solution when the body turns 1.5 deg and moves 16 mm within the cycle.
constexpr double kStartRotation_rad = 0.06, kStartPosition_m = 0.1;
// Longest single prediction: accurate enough for a body that turns at 10 rad/s.
constexpr double kLongestStep_s = 0.01;

void predict(ImmFilter& filter, double dt_s) {
  while (dt_s > 1.5 * kLongestStep_s) {
    filter.predict(kLongestStep_s);
    dt_s -= kLongestStep_s;
  }
  if (dt_s > 0.0) filter.predict(dt_s);
}

// Chi-squared of a sweep (five degrees of freedom) beyond every model's gate: one in ten million.
constexpr double kRateResetChi2 = 40.0;
// Rounding does not lift chi-squared from this part of a limit beyond it.
constexpr double kFarBelow = 0.9;
// Of a sweep beyond what the filter's present models hold possible, by far: a quiet body was pushed, or the sweep is
// wrong. It is withheld; the next one of either rotor tells.
constexpr double kSurpriseChi2 = 200.0;
// Of coplanar sensors. Taken for a push, a sweep that is a millimetre off opens the attitude, and their tilt's side is
// lost; it returns by chance.
constexpr double kCoplanarSurpriseChi2 = 40.0;
// Of a sweep that the next ones must agree with: one in 800 by noise alone, and as little as opens the filter.
constexpr double kDoubtfulChi2 = 20.0;
// A sweep that rotates the estimate by less is linear enough; how often one that rotates it further is linearised
// again.
constexpr double kStraight_rad = 0.02;
constexpr int kFollowed = 3;

// A body that was pushed must be confirmed anew by so many sweeps, two of each rotor.
constexpr int kSettles = 4;
// Squared distance (6 degrees of freedom) up to which an alternative is the best hypothesis itself.
constexpr double kSamePose = 1.0;

// `chi2`: of the sweep by the prediction's own covariance. The gate's holds that one, and makes no sweep less probable.
bool exceeds_rate_reset_gate(const SweepFit& fit, const StateEstimate& prediction, double chi2) {
  if (2 * static_cast<int>(fit.used.size()) < fit.sensors) return true;
  if (chi2 < kFarBelow * kRateResetChi2) return false;
  return innovation_of(fit.information, prediction.gate_covariance, Vector6::Zero()).chi2 > kRateResetChi2;
}

bool is_surprise(const SweepFit& fit, double chi2) {
  return chi2 > kSurpriseChi2 || (chi2 > kCoplanarSurpriseChi2 && SensorPlane::of(fit.used).holds_all);
}

}  // namespace

std::int64_t last_hit_ticks(const lighthouse::SweepBearings& bearings, const Target& target) {
  std::int64_t last = INT64_MIN;
  for (std::size_t i = bearings.size(); i-- > 0;) {  // the last one is often it
    if (bearings[i].time_ticks > last && find_sensor(target, bearings[i].sensor) != nullptr) {
      last = bearings[i].time_ticks;
    }
  }
  return last;
}

bool same_pose(const Hypothesis& best, const Hypothesis& alternative) {
  const StateEstimate& state_estimate = best.state_estimate();
  return mahalanobis_squared(alternative.state_estimate().pose, state_estimate.pose, state_estimate.covariance) <
         kSamePose;
}

Hypothesis::Hypothesis(const track::Cycle& cycle, const LighthouseFromBody& pose, const Vector6* rate,
                       double noise_scale, const StationView& view, const AssumedNoise& noise) {
  LighthouseFromBody start = pose;
  for (int round = 0; round < 2; ++round) {
    *this = Hypothesis();
    filter_.start(start, kStartRotation_rad, kStartPosition_m, rate);
    station_states_[0].level = std::clamp(noise_scale * noise_scale, kMinLevel, kMaxLevel);
    std::int64_t begun_ticks = INT64_MIN;
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const std::int64_t last = last_hit_ticks(cycle[axis], *view.target);
      if (last == INT64_MIN) continue;
      if (begun_ticks == INT64_MIN) begun_ticks = time_ticks_ = last;
      push(cycle[axis], axis, view, noise);
    }
    start = predicted(begun_ticks).pose;
  }
  agreements_ = fitted_ = undisputed_ = 0;
  confirmed_ = false;
}

void Hypothesis::link(const StationFromStation& T_second_reference, const Matrix6& covariance, bool surveyed) {
  filter_.link(T_second_reference, covariance);
  surveyed_ = surveyed;
  station_states_[1] = {};
}

const SweepFit& Hypothesis::push(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                                 const AssumedNoise& noise, Observer observer, std::optional<Hypothesis>* without) {
  const std::int64_t time = std::max(time_ticks_, last_hit_ticks(bearings, *view.target));
  const double since_s = ticks_to_seconds(time - time_ticks_);
  const bool quiet = filter_.quiet(), was_steady = filter_.steady();
  predict(filter_, since_s);
  if (filter_.linked() && !surveyed_) inflate_relative_covariance(since_s);
  time_ticks_ = time;
  observer_ = observer;
  ++sweeps_;
  StationState& station_state = this->station_state(observer);
  const auto axis_index = static_cast<std::size_t>(index_of(axis));
  const SweepNoise now{noise.sigma_rad * std::sqrt((1.0 - noise.rho) * station_state.level),
                       noise.sigma_rad * std::sqrt(noise.rho)};
  StateEstimate prediction = with_systematics(filter_, observer);
  fit_ = fit_sweep(bearings, axis, view, prediction, time, now);
  Innovation innovation = innovation_of(fit_.information, prediction.covariance, Vector6::Zero());
  const bool judged = fit_.sensors >= kMinSensorsToJudge;
  const bool contradicts = judged && exceeds_rate_reset_gate(fit_, prediction, innovation.chi2);
  const double chi2 = judged && !fit_.used.empty() ? innovation.chi2 : 0.0;
  const bool surprises = contradicts || is_surprise(fit_, chi2);
  Leaps& leaps_of_rotor = station_state.leaps[axis_index];
  bool& rotor_contradicted = station_state.contradicted[axis_index];
  const bool leapt = leaps(fit_, prediction, now, leaps_of_rotor.since_taken_s(time)) &&
                     !leaps_of_rotor.go_on(fit_, !quiet && rotor_contradicted);
  const bool improbable = shift_is_improbable(fit_, prediction, now);
  leaps_of_rotor.set(leapt, fit_);
  withheld_ = leapt || (quiet && surprises && !contradicted_ && !rotor_contradicted);
  const bool pushed = quiet && surprises && !withheld_ && sweeps_ > kSettled;
  contradicted_ = rotor_contradicted = surprises;
  // Sweeps of a station of unknown calibration contradict one another without being wrong.
  const bool doubtful = was_steady && !withheld_ && sweeps_ > kSettled && view.calibration != nullptr &&
                        (surprises || chi2 > kDoubtfulChi2);
  if (doubtful && without != nullptr) without->emplace(*this).leave_out();
  rates_reset_ = contradicts && !withheld_;
  if (rates_reset_) {
    filter_.reset_rates(since_s);
    prediction = with_systematics(filter_, observer);
    fit_ = fit_sweep(bearings, axis, view, prediction, time, now);
    innovation = innovation_of(fit_.information, prediction.covariance, Vector6::Zero());
  }
  follow(bearings, axis, view, prediction, now, innovation);
  withheld_ = withheld_ || hits_disagree(fit_);
  diverged_ = diverged_ || withheld_;
  const int used = static_cast<int>(fit_.used.size());
  // A shaken body's state may be that of wrong sweeps before the leap.
  dispute({leapt, (leapt && !quiet) || (improbable && shifts_far(fit_)), pushed});
  if (used > 0 && !diverged_) leaps_of_rotor.taken(time);
  consecutive_rejections_ = contradicts || used == 0 || 2 * used < fit_.sensors ? consecutive_rejections_ + 1 : 0;
  // How badly a withheld sweep fits decides nothing between two hypotheses that both withhold it.
  cost_ += withheld_ ? fit_.sensors * kStrayLogDensity : fit_.log_density;
  if (diverged_) {
    // The state stays as predicted.
    cost_ += withheld_ ? 0.0 : nis_;
    agreements_ = 0;
    fitted_ = 0;
    confirmed_ = confirmed_ && withheld_;
  } else if (used > 0) {
    agreements_ = rates_reset_ || nis_ > kRateResetChi2 ? 0 : agreements_ + 1;
    // A body that has just been found is confirmed by sweeps that agree: with new rates a wrong start takes one rotor's
    // sweeps after the other's, and contradicts each in turn.
    fitted_ = agreements_ > 0 || sweeps_ > kSettled ? fitted_ + 1 : 0;
    confirmed_ = confirmed_ || fitted_ >= kOneOfEachRotor;
    const double own_variance = noise.sigma_rad * noise.sigma_rad * (1.0 - noise.rho);
    const CycleInformation::ResidualChi2 residual_chi2 =
        station_state.view.set(axis, fit_.used, station_state.level * own_variance, time, view.calibration == nullptr);
    cost_ += filter_.correct(fit_.information, fit_.pose, observer);
    state_estimate_ = filter_.state_estimate(observer);
    station_state.view.shifted(axis, pose_difference(state_estimate_.pose, fit_.pose));
    station_state.seen_ticks = last_used_ticks_ = time;
    learn_noise(station_state, residual_chi2);
    station_state.systematic = systematic_covariance(station_state, state_estimate_.pose.t.norm(), noise);
  }
  if (diverged_ || used == 0) state_estimate_ = filter_.state_estimate(observer);
  add_systematics(state_estimate_, observer);
  judge_tilt(view.calibration != nullptr);
  see_tilt();
  return fit_;
}

// The last sweep, whose time it was predicted to: it is compared from here on with the one that took it.
void Hypothesis::leave_out() {
  withheld_ = diverged_ = true;
  agreements_ = fitted_ = 0;
  reset_cost();
  state_estimate_ = with_systematics(filter_, observer_);
}

// How strongly the sweep speaks against the target, and for how long nothing did.
void Hypothesis::dispute(const Objections& objections) {
  dispute_ = objections.leapt ? 1.0 : dispute_of(fit_, withheld_, nis_);
  undisputed_ = dispute_ > kSomeDispute ? 0 : undisputed_ + 1;
  if (objections.of_state || objections.pushed) confirm_anew();
  if (objections.pushed) dispute_ = std::max(dispute_, kSomeDispute);
}

void Hypothesis::confirm_anew() { undisputed_ = -kSettles; }

// Covariance of the attitude after the sweep, as far as it can be corrected: systematic errors do not shrink. No sweep
// makes it larger; where it is small before, it is not calculated.
Matrix3 Hypothesis::attitude_after(const Matrix6& known, const Vector6& offset) const {
  const Matrix3 before = known.topLeftCorner<3, 3>();
  if (before.trace() <= kLinear_rad * kLinear_rad) return before;
  const Innovation innovation = innovation_of(fit_.information, known, offset);
  return corrected_covariance(known, fit_.information, innovation).topLeftCorner<3, 3>();
}

// Innovation of a sweep. One that rotates the estimate far is linearised again at the corrected pose (iterated extended
// Kalman filter): at a tenth of a radian a bearing's second-order part is many times its noise.
void Hypothesis::follow(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                        const StateEstimate& prediction, const SweepNoise& now, Innovation innovation) {
  Vector6 offset = Vector6::Zero();  // the prediction's pose minus the one linearised at
  for (int round = 0; round < kFollowed; ++round) {
    const Vector6 shift = pose_shift(fit_.information, innovation);
    if ((shift + offset).head<3>().norm() < kStraight_rad) break;
    StateEstimate there = prediction;
    there.pose = prediction.pose.moved_by(shift);
    const SweepFit again = fit_sweep(bearings, axis, view, there, time_ticks_, now);
    if (again.used.size() < fit_.used.size()) break;
    fit_ = again;
    offset = -shift;
    innovation = innovation_of(fit_.information, prediction.covariance, offset);
  }
  if (!fit_.used.empty()) plane_ = SensorPlane::of(fit_.used);
  predicted_covariance_ = prediction.covariance;
  predicted_offset_ = offset;
  coplanar_ = false;
  if (!fit_.used.empty() && filter_.steady()) {
    const Matrix3 attitude = attitude_after(prediction.covariance - systematic_of(observer_), offset);
    if (attitude.trace() > kLinear_rad * kLinear_rad) {
      coplanar_ = plane_.holds_all;
      if (coplanar_) {
        count_second_order(fit_, plane_, attitude, now);
        innovation = innovation_of(fit_.information, prediction.covariance, offset);
      }
    }
  }
  nis_ = innovation.chi2;
  diverged_ = nis_ > kRateResetChi2 &&
              innovation_of(fit_.information, prediction.gate_covariance, offset).chi2 > kRateResetChi2;
}

StateEstimate Hypothesis::predicted(std::int64_t time_ticks, Observer observer) const {
  const double dt_s = ticks_to_seconds(time_ticks - time_ticks_);
  if (dt_s == 0.0) return observer == observer_ ? state_estimate_ : with_systematics(filter_, observer);
  ImmFilter filter = filter_;
  if (dt_s < 0.0) {
    filter.predict_mean(dt_s);
  } else {
    predict(filter, dt_s);
  }
  return with_systematics(filter, observer);
}

}  // namespace pharos::motion
