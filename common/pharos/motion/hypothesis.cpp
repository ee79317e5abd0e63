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
// Range of the estimated own variance over the assumed one, and the degrees of freedom that it averages over.
constexpr double kMinLevel = 0.8, kMaxLevel = 1e4;
constexpr double kLevelFreedom = 200.0, kLevelPrior = 2.0;
// Up to here the estimated variance may be noise alone: narrow hits, a noisier rotor.
constexpr double kWhiteLevel = 2.0;
constexpr double kSurelyResting = 0.9;
// Maximum that systematic errors may add to a result.
constexpr double kCarriedRotation_rad = 0.2, kCarriedPosition_m = 0.2;
// Time in which the systematic errors re-enter the covariance of an estimated second station's pose: the body has then
// moved to where sensor errors act differently.
constexpr double kLinkForgets_s = 1.0;
// A station that saw the body this recently still counts.
constexpr double kFresh_s = 0.1;
// One sweep moves the noise level by no more than this many times its expectation.
constexpr double kLargestRatio = 9.0;

void predict(ImmFilter& filter, double dt_s) {
  while (dt_s > 1.5 * kLongestStep_s) {
    filter.predict(kLongestStep_s);
    dt_s -= kLongestStep_s;
  }
  if (dt_s > 0.0) filter.predict(dt_s);
}

// Chi-squared of a sweep (five degrees of freedom) beyond every model's gate: one in ten million.
constexpr double kRateResetChi2 = 40.0;
// Of a sweep beyond what the filter's present models hold possible, by far: a quiet body was pushed, or the sweep is
// wrong. It is withheld; the next one of either rotor tells.
constexpr double kSurpriseChi2 = 200.0;
// Of coplanar sensors. Taken for a push, a sweep that is a millimetre off opens the attitude, and their tilt's side is
// lost; it returns by chance.
constexpr double kCoplanarSurpriseChi2 = 40.0;
// Of a sweep that the next ones must agree with: one in 800 by noise alone, and as little as opens the filter.
constexpr double kDoubtfulChi2 = 20.0;
// Probability of the model of highest process noise from which on the body is shaken, and surprises are its own.
constexpr double kAgitated = 0.3;
// A body that a hand moves quickly has another attitude error in every sweep.
bool steady(const ImmFilter& filter) {
  const auto& probability = filter.probability();
  return probability[ImmFilter::kModels - 2] + probability[ImmFilter::kModels - 1] < kAgitated;
}
// Sweeps in a row that confirm a state: one of each rotor.
constexpr int kConfirming = 2;
// A sweep that rotates the estimate by less is linear enough; how often one that rotates it further is linearised
// again.
constexpr double kStraight_rad = 0.02;
constexpr int kFollowed = 3;

// A body that is pushed after so many sweeps is not one that has just been found: it must be confirmed anew by so many,
// two of each rotor.
constexpr int kSettled = 16, kSettles = 4;
// Coplanar sensors whose attitude is known no better than this may be tilted to the other side as well. After a start
// only the tilt itself speaks for the side (0.03 rad about each of two axes), later the motion before does too; and the
// hypothesis of the other side, which is not followed before a station of unknown calibration.
constexpr double kMaxTiltAtStart_rad = 0.042, kMaxTilt_rad = 2.0 * kTiltAlone_rad;

// Squared distance (6 degrees of freedom) up to which an alternative is the best hypothesis itself.
constexpr double kSamePose = 1.0;

bool exceeds_rate_reset_gate(const SweepFit& fit, const StateEstimate& prediction) {
  if (2 * static_cast<int>(fit.used.size()) < fit.sensors) return true;
  return innovation_of(fit.information, prediction.gate_covariance, Vector6::Zero()).chi2 > kRateResetChi2;
}

// Chi-squared of a sweep that can be judged, else zero.
double chi2_of(const SweepFit& fit, const StateEstimate& prediction) {
  if (fit.sensors < kMinSensorsToJudge || fit.used.empty()) return 0.0;
  return innovation_of(fit.information, prediction.covariance, Vector6::Zero()).chi2;
}

bool is_surprise(const SweepFit& fit, double chi2) {
  return chi2 > kSurpriseChi2 || (chi2 > kCoplanarSurpriseChi2 && SensorPlane::of(fit.used).holds_all);
}

}  // namespace

std::int64_t last_hit_ticks(const lighthouse::SweepBearings& bearings, const Target& target) {
  std::int64_t last = INT64_MIN;
  for (const lighthouse::Bearing& bearing : bearings) {
    if (find_sensor(target, bearing.sensor) != nullptr) last = std::max(last, bearing.time_ticks);
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
  const bool quiet = filter_.probability().back() < kAgitated, was_steady = steady(filter_);
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
  const bool contradicts = fit_.sensors >= kMinSensorsToJudge && exceeds_rate_reset_gate(fit_, prediction);
  const double chi2 = chi2_of(fit_, prediction);
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
  }
  follow(bearings, axis, view, prediction, now);
  withheld_ = withheld_ || hits_disagree(fit_);
  diverged_ = diverged_ || withheld_;
  const int used = static_cast<int>(fit_.used.size());
  // A shaken body's state may be that of wrong sweeps before the leap.
  dispute(leapt, (leapt && !quiet) || (improbable && shifts_far(fit_)), pushed);
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
    confirmed_ = confirmed_ || fitted_ >= kConfirming;
    const double own_variance = noise.sigma_rad * noise.sigma_rad * (1.0 - noise.rho);
    const CycleInformation::ResidualChi2 residual_chi2 =
        station_state.view.set(axis, fit_.used, station_state.level * own_variance, time, view.calibration == nullptr);
    cost_ += filter_.correct(fit_.information, fit_.pose, observer);
    const LighthouseFromBody corrected = filter_.state_estimate(observer).pose;
    station_state.view.shifted(axis, pose_difference(corrected, fit_.pose));
    station_state.seen_ticks = last_used_ticks_ = time;
    learn_noise(station_state, residual_chi2);
    station_state.systematic = systematic_covariance(station_state, corrected.t.norm(), noise);
  }
  state_estimate_ = with_systematics(filter_, observer);
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

// Mirrored, coplanar sensors fit as well. Sensors with relief tell the side, once each rotor has seen them: one alone
// makes the attitude certain about its own axis, and leaves an error about the other that the stated sigma no longer
// holds.
void Hypothesis::judge_tilt(bool both_sides_followed) {
  tilt_unknown_ = false;
  if (fit_.used.empty() || !steady(filter_)) return;
  if (!coplanar_) {
    if (++sweeps_of_relief_ >= kConfirming) side_doubtful_ = false;
    tilt_unknown_ = side_doubtful_;
    return;
  }
  sweeps_of_relief_ = 0;
  const Matrix6 known = state_estimate_.covariance - systematic_of(observer_);
  const double square = known.topLeftCorner<3, 3>().trace();
  const double max_tilt_rad = both_sides_followed || sweeps_ > kSettled ? kMaxTilt_rad : kMaxTiltAtStart_rad;
  tilt_unknown_ = square > max_tilt_rad * max_tilt_rad;
  side_doubtful_ = square > kTiltAlone_rad * kTiltAlone_rad;
}

// How strongly the sweep speaks against the target, and for how long nothing did.
void Hypothesis::dispute(bool leapt, bool in_doubt, bool pushed) {
  dispute_ = leapt ? 1.0 : dispute_of(fit_, withheld_, nis_);
  undisputed_ = dispute_ > kSomeDispute ? 0 : undisputed_ + 1;
  if (in_doubt || pushed) confirm_anew();
  if (pushed) dispute_ = std::max(dispute_, kSomeDispute);
}

void Hypothesis::confirm_anew() { undisputed_ = -kSettles; }

// Innovation of a sweep. One that rotates the estimate far is linearised again at the corrected pose (iterated extended
// Kalman filter): at a tenth of a radian a bearing's second-order part is many times its noise.
void Hypothesis::follow(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                        const StateEstimate& prediction, const SweepNoise& now) {
  Vector6 offset = Vector6::Zero();  // the prediction's pose minus the one linearised at
  Innovation innovation = innovation_of(fit_.information, prediction.covariance, offset);
  for (int round = 0; round < kFollowed; ++round) {
    const Vector6 shift = pose_shift(prediction.covariance, fit_.information, innovation);
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
  if (!fit_.used.empty() && steady(filter_)) {
    const Matrix6 known = prediction.covariance - systematic_of(observer_);  // systematic errors do not shrink
    const Innovation of_known = innovation_of(fit_.information, known, offset);
    const Matrix3 attitude = corrected_covariance(known, fit_.information, of_known).topLeftCorner<3, 3>();
    if (attitude.trace() > kLinear_rad * kLinear_rad) {
      coplanar_ = plane_.holds_all;
      if (coplanar_) count_second_order(fit_, plane_, attitude, now);
      innovation = innovation_of(fit_.information, prediction.covariance, offset);
    }
  }
  nis_ = innovation.chi2;
  diverged_ = nis_ > kRateResetChi2 &&
              innovation_of(fit_.information, prediction.gate_covariance, offset).chi2 > kRateResetChi2;
}

// A sweep of six hits and more shows their noise by itself. Five show it only together with the sweep before, and only
// while the body is stationary: the effect of a wrong rate between two sweeps is not noise, and a filter that took it
// for noise would weight its measurements too low and its rates would become worse.
void Hypothesis::learn_noise(StationState& station_state, const CycleInformation::ResidualChi2& cycle) const {
  CycleInformation::ResidualChi2 seen = {fit_.information.residual_chi2,
                                         static_cast<double>(fit_.information.hits - fit_.information.rank)};
  // Each sweep is used twice, with the one before and the one after.
  if (!(seen.freedom > 0.0) && filter_.probability().front() > kSurelyResting)
    seen = {0.5 * cycle.square, 0.5 * cycle.freedom};
  if (!(seen.freedom > 0.0)) return;
  const double ratio = std::min(seen.square / seen.freedom, kLargestRatio);
  station_state.noise_degrees_of_freedom =
      std::min(station_state.noise_degrees_of_freedom + seen.freedom, kLevelFreedom);
  const double gain = seen.freedom / (station_state.noise_degrees_of_freedom + kLevelPrior);
  station_state.level = std::clamp(station_state.level * (1.0 + gain * (ratio - 1.0)), kMinLevel, kMaxLevel);
}

Matrix6 Hypothesis::systematic_covariance(const StationState& station_state, double range_m,
                                          const AssumedNoise& noise) const {
  const double own_variance = noise.sigma_rad * noise.sigma_rad * (1.0 - noise.rho);
  const double sensor_rad = noise.systematic.sensor_position_m / range_m;
  // Sensor errors that the residuals show are not counted twice.
  const double of_sensors = std::max((station_state.level - kWhiteLevel) * own_variance, sensor_rad * sensor_rad);
  const double of_rotors = noise.systematic.rotor_rad * noise.systematic.rotor_rad;
  Matrix6 carried = station_state.view.covariance_of(std::max(0.0, of_sensors), of_rotors);
  // Two sweeps that hardly constrain the pose also hardly correct the estimate.
  const double rotation = carried.topLeftCorner<3, 3>().trace() / (kCarriedRotation_rad * kCarriedRotation_rad);
  const double position = carried.bottomRightCorner<3, 3>().trace() / (kCarriedPosition_m * kCarriedPosition_m);
  carried *= 1.0 / std::max({1.0, rotation, position});
  return carried;
}

// Systematic errors of the two views depend on the body's position: a relative pose that was estimated from them is no
// better than they are, and its covariance grows again while the body moves.
void Hypothesis::inflate_relative_covariance(double dt_s) {
  const SecondStation& second = filter_.second();
  const SecondView view(filter_.state_estimate().pose, second.pose);
  const Matrix6 seen =
      station_states_[1].systematic +
      view.by_body.lazyProduct(Matrix6(station_states_[0].systematic.lazyProduct(view.by_body.transpose())));
  Matrix6 back = view.by_second;
  back.bottomLeftCorner<3, 3>() *= -1.0;  // its inverse
  filter_.inflate_relative_covariance((dt_s / kLinkForgets_s) *
                                      back.lazyProduct(Matrix6(seen.lazyProduct(back.transpose()))));
}

// Where both stations see the body, the systematic errors are no larger than those of the better station alone.
Matrix6 Hypothesis::systematic_of(Observer observer) const {
  const Matrix6& own = station_state(observer).systematic;
  if (!filter_.linked()) return own;
  const StationState& other =
      station_state(observer == Observer::kReference ? Observer::kSecond : Observer::kReference);
  if (other.seen_ticks == INT64_MIN || ticks_to_seconds(time_ticks_ - other.seen_ticks) > kFresh_s) return own;
  const std::int64_t own_ticks = station_state(observer).seen_ticks;
  const bool own_fresh = own_ticks != INT64_MIN && ticks_to_seconds(time_ticks_ - own_ticks) <= kFresh_s;
  const Matrix3 turn = filter_.second().pose.R;
  Matrix6 by = Matrix6::Zero();
  by.topLeftCorner<3, 3>() = by.bottomRightCorner<3, 3>() =
      observer == Observer::kSecond ? turn : Matrix3(turn.transpose());
  const Matrix6 mapped = by.lazyProduct(Matrix6(other.systematic.lazyProduct(by.transpose())));
  const bool own_known = own_fresh && !own.isZero(0.0);
  return own_known && own.trace() <= mapped.trace() ? own : mapped;
}

// What exceeds the assumed noise is attributed to wrong sensor positions and rotor parameters. It is the same in every
// sweep of a view, so averaging does not remove it: it is added to the covariance from the sweeps.
StateEstimate Hypothesis::with_systematics(const ImmFilter& filter, Observer observer) const {
  StateEstimate state_estimate = filter.state_estimate(observer);
  const Matrix6 systematic = systematic_of(observer);
  state_estimate.covariance += systematic;
  state_estimate.gate_covariance += systematic;
  return state_estimate;
}

bool Hypothesis::noise_implausible() const { return station_state(observer_).level >= kMaxLevel; }

double Hypothesis::noise_scale(Observer observer) const { return std::sqrt(station_state(observer).level); }

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
