// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/imm_filter.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::motion {
namespace {

constexpr std::size_t kModels = ImmFilter::kModels;
constexpr std::size_t kMoving = ImmFilter::kMoving;

// White jerk that drives the moving models: spectral densities, (rad/s^3)^2 s and (m/s^3)^2 s. From a satellite's slow
// drift over a manoeuvre at 0.5 m/s and 60 deg/s to a target shaken by hand.
struct Jerk {
  double rotation, translation;
};
constexpr std::array<Jerk, kMoving> kJerk{{{0.003, 0.0003}, {0.1, 0.03}, {10.0, 6.0}, {2e6, 2e4}}};
// A stationary body drifts (a table that yields, temperature): a random walk of 0.1 mm and 0.006 deg in three hours
// keeps the gain of the static model above zero.
constexpr double kCreepRotation = 1e-12, kCreepTranslation = 1e-12;  // rad^2/s, m^2/s

// Standard deviations at the onset of motion: rate and acceleration, rotation and translation.
struct Onset {
  double rotation_rate, velocity, rotation_acceleration, acceleration;
};
constexpr std::array<Onset, kMoving> kOnset{
    {{0.05, 0.02, 0.1, 0.03}, {0.1, 0.05, 0.3, 0.1}, {0.3, 0.1, 2.0, 0.5}, {1.0, 0.3, 10.0, 3.0}}};
constexpr std::array<Onset, kMoving> kRoughlyKnown{
    {{1.0, 0.5, 0.3, 0.1}, {1.0, 0.5, 1.0, 0.5}, {2.0, 1.0, 10.0, 3.0}, {4.0, 1.5, 100.0, 50.0}}};
constexpr std::array<Onset, kMoving> kUnknown{
    {{2.0, 1.0, 0.3, 0.1}, {2.0, 1.0, 1.0, 0.5}, {5.0, 3.0, 10.0, 3.0}, {15.0, 5.0, 100.0, 50.0}}};

// Transition rates per second, from row to column: static, then moving by increasing process noise.
constexpr double kChange[kModels][kModels] = {{0.0, 0.1, 0.1, 0.05, 0.01},
                                              {0.1, 0.0, 0.2, 0.05, 0.01},
                                              {0.1, 0.2, 0.0, 0.5, 0.02},
                                              {0.01, 0.02, 1.0, 0.0, 1.0},
                                              {0.01, 0.01, 0.02, 1.0, 0.0}};
// Only a slow body becomes stationary between two sweeps: rates, 1 sigma, that friction stops at once.
constexpr double kHaltingRate_rad_s = 0.1, kHaltingVelocity_m_s = 0.03;
// A model with larger sigmas of the pose than these has lost the body: it restarts from the models of lower process
// noise. So does one of negligible probability whose rates are these squared sigmas from those of the next lower one:
// rates that differ by whole rotations a sweep give the same poses, and no sweep would ever contradict them.
constexpr double kAstray = 100.0;
constexpr double kLostRotation_rad = 0.5, kLostPosition_m = 0.5;
constexpr double kMaxFilterStep_s = 0.05;
// Smaller fractions are not mixed; less probable models are not corrected, but restarted from the others.
constexpr double kNegligible = 1e-3;
// No model becomes less probable. One that is hardly more probable is no part of the mixture of a steady body: the
// static model, whose covariance hardly lets it follow a body that moves on, runs away by kilometres in a second. Of a
// shaken body all models are, as its gates have room for a hand.
constexpr double kMinProbability = 1e-9, kMinCounted = 1e-8, kShaken = 0.3;

template <class Parent, class Child>
Vector6 small_difference(const Pose<Parent, Child>& to, const Pose<Parent, Child>& from) {
  const Matrix3 turn = to.R.lazyProduct(from.R.transpose());
  Vector6 delta;
  delta << 0.5 * (turn(2, 1) - turn(1, 2)), 0.5 * (turn(0, 2) - turn(2, 0)), 0.5 * (turn(1, 0) - turn(0, 1)),
      to.t - from.t;
  return delta;
}

void set_variances(Matrix6& covariance, double rotation_sigma, double translation_sigma) {
  covariance.setZero();
  covariance.diagonal().head<3>().setConstant(rotation_sigma * rotation_sigma);
  covariance.diagonal().tail<3>().setConstant(translation_sigma * translation_sigma);
}

MovingState beginning_to_move(const RestingState& resting, const Onset& onset) {
  MovingState state;
  state.pose = resting.pose;
  state.pp = resting.covariance;
  state.second = resting.second;
  set_variances(state.rr, onset.rotation_rate, onset.velocity);
  set_variances(state.aa, onset.rotation_acceleration, onset.acceleration);
  return state;
}

void blend_block(Matrix6& into, const Matrix6& other, double weight, const Vector6& left, const Vector6& right) {
  into += weight * (other - into) + (weight * (1.0 - weight) * left).lazyProduct(right.transpose());
}

// What the moments of the second station's pose become; `p`: how far apart the poses are.
Vector6 blend_station(SecondStation& into, const SecondStation& other, double weight, const Vector6& p) {
  const Vector6 s = small_difference(other.pose, into.pose);
  blend_block(into.ss, other.ss, weight, s, s);
  blend_block(into.sp, other.sp, weight, s, p);
  into.pose = into.pose.moved_by(weight * s);
  return s;
}

// Moments of a mixture of two estimates, the second with the fraction `weight`.
void blend(RestingState& into, const MovingState& other, double weight, bool linked) {
  const Vector6 p = small_difference(other.pose, into.pose);
  blend_block(into.covariance, other.pp, weight, p, p);
  if (linked) blend_station(into.second, other.second, weight, p);
  into.pose = into.pose.moved_by(weight * p);
}

void blend(MovingState& into, const MovingState& other, double weight, bool linked) {
  const Vector6 p = small_difference(other.pose, into.pose);
  const Vector6 r = other.rate - into.rate, a = other.acceleration - into.acceleration;
  blend_block(into.pp, other.pp, weight, p, p);
  blend_block(into.rp, other.rp, weight, r, p);
  blend_block(into.rr, other.rr, weight, r, r);
  blend_block(into.ap, other.ap, weight, a, p);
  blend_block(into.ar, other.ar, weight, a, r);
  blend_block(into.aa, other.aa, weight, a, a);
  if (linked) {
    const Vector6 s = blend_station(into.second, other.second, weight, p);
    blend_block(into.second.sr, other.second.sr, weight, s, r);
    blend_block(into.second.sa, other.second.sa, weight, s, a);
  }
  into.pose = into.pose.moved_by(weight * p);
  into.rate += weight * r;
  into.acceleration += weight * a;
}

// Probability that the estimated rates are small enough to stop: the overlap of the two Gaussians, exp and volume.
double may_halt(const MovingState& state) {
  double volume = 1.0, square = 0.0;
  for (int k = 0; k < 6; ++k) {
    const double halting = k < 3 ? kHaltingRate_rad_s : kHaltingVelocity_m_s;
    const double variance = state.rr(k, k) + halting * halting;
    volume *= halting * halting / variance;
    square += state.rate[k] * state.rate[k] / variance;
  }
  return std::sqrt(volume) * std::exp(-0.5 * square);
}

}  // namespace

void ImmFilter::start(const LighthouseFromBody& pose, double sigma_rotation_rad, double sigma_position_m,
                      const Vector6* rate) {
  resting_.pose = pose;
  set_variances(resting_.covariance, sigma_rotation_rad, sigma_position_m);
  for (std::size_t m = 0; m < kMoving; ++m) {
    moving_[m] = beginning_to_move(resting_, rate != nullptr ? kRoughlyKnown[m] : kUnknown[m]);
    if (rate != nullptr) moving_[m].rate = *rate;
  }
  probability_ = {0.3, 0.15, 0.15, 0.2, 0.2};
}

bool ImmFilter::lost(std::size_t m) const {
  const MovingState& state = moving_[m];
  if (state.pp.topLeftCorner<3, 3>().trace() > kLostRotation_rad * kLostRotation_rad) return true;
  if (state.pp.bottomRightCorner<3, 3>().trace() > kLostPosition_m * kLostPosition_m) return true;
  if (m == 0 || probability_[m + 1] > kNegligible) return false;
  const MovingState& calmer = moving_[m - 1];
  const Vector6 apart = (state.rate - calmer.rate).cwiseAbs2();
  const Vector6 allowed = (state.rr + calmer.rr).diagonal();
  return (apart.array() > kAstray * allowed.array()).any();
}

void ImmFilter::interact(double dt_s) {
  const double dt = std::min(dt_s, kMaxFilterStep_s);
  Flow flow;  // probability of having gone from i to j
  std::array<double, kModels> next{};
  for (std::size_t i = 0; i < kModels; ++i) {
    double stays = 1.0;
    for (std::size_t j = 0; j < kModels; ++j) {
      const double goes = i > 0 && j == 0 ? kChange[i][0] * may_halt(moving_[i - 1]) : kChange[i][j];
      flow[i][j] = probability_[i] * goes * dt;
      stays -= goes * dt;
    }
    flow[i][i] = probability_[i] * stays;
    for (std::size_t j = 0; j < kModels; ++j) next[j] += flow[i][j];
  }
  for (std::size_t m = 0; m < kMoving; ++m) {
    if (!lost(m)) continue;
    if (m == 0) {
      moving_[0] = beginning_to_move(resting_, kOnset[0]);
    } else {
      moving_[m] = moving_[m - 1];
    }
  }
  // Models take over from those of higher process noise, in this order, which leaves every source as it was.
  double sum = flow[0][0];
  for (std::size_t i = 1; i < kModels; ++i) {
    if (flow[i][0] <= kNegligible * next[0]) continue;
    sum += flow[i][0];
    blend(resting_, moving_[i - 1], flow[i][0] / sum, linked_);
  }
  for (std::size_t j = 1; j < kModels; ++j) {
    sum = flow[j][j];
    for (std::size_t i = j + 1; i < kModels; ++i) {
      if (flow[i][j] <= kNegligible * next[j]) continue;
      sum += flow[i][j];
      blend(moving_[j - 1], moving_[i - 1], flow[i][j] / sum, linked_);
    }
  }
  probability_ = next;
}

void ImmFilter::predict(double dt_s) {
  interact(dt_s);
  for (int k = 0; k < 3; ++k) {
    resting_.covariance(k, k) += kCreepRotation * dt_s;
    resting_.covariance(k + 3, k + 3) += kCreepTranslation * dt_s;
  }
  for (std::size_t m = 0; m < kMoving; ++m) {
    if (linked_) moving_[m].predict_second(dt_s);
    moving_[m].predict(dt_s, kJerk[m].rotation, kJerk[m].translation);
  }
}

void ImmFilter::reset_rates(double dt_s) {
  const StateEstimate now = state_estimate();
  MovingState& highest_noise = moving_.back();
  highest_noise.pose = now.pose;
  highest_noise.rate = now.rate;
  highest_noise.pp = now.covariance;
  highest_noise.rp.setZero();
  highest_noise.ap.setZero();
  highest_noise.ar.setZero();
  highest_noise.second.sp.setZero();
  highest_noise.second.sr.setZero();
  highest_noise.second.sa.setZero();
  constexpr Onset unknown = {8.0, 2.5, 100.0, 50.0};
  set_variances(highest_noise.rr, unknown.rotation_rate, unknown.velocity);
  set_variances(highest_noise.aa, unknown.rotation_acceleration, unknown.acceleration);
  highest_noise.pp += (dt_s * dt_s) * highest_noise.rr;
  highest_noise.rp += dt_s * highest_noise.rr;
  probability_ = {0.005, 0.005, 0.01, 0.08, 0.9};
}

void ImmFilter::predict_mean(double dt_s) {
  for (MovingState& m : moving_) m.predict_mean(dt_s);
}

void ImmFilter::link(const StationFromStation& T_second_reference, const Matrix6& covariance) {
  linked_ = true;
  resting_.second = {T_second_reference, covariance};
  for (MovingState& m : moving_) m.second = resting_.second;
}

void ImmFilter::inflate_relative_covariance(const Matrix6& covariance) {
  resting_.second.ss += covariance;
  for (MovingState& m : moving_) m.second.ss += covariance;
}

void ImmFilter::mirror(const Tilt& tilt) {
  resting_.mirror(tilt);
  for (MovingState& state : moving_) state.mirror(tilt);
}

std::size_t ImmFilter::most_probable() const {
  return static_cast<std::size_t>(std::max_element(probability_.begin(), probability_.end()) - probability_.begin());
}

const SecondStation& ImmFilter::second() const {
  const std::size_t top = most_probable();
  return top == 0 ? resting_.second : moving_[top - 1].second;
}

ImmFilter::Seen ImmFilter::seen(std::size_t i, Observer observer) const {
  const LighthouseFromBody& pose = i == 0 ? resting_.pose : moving_[i - 1].pose;
  const Matrix6& covariance = i == 0 ? resting_.covariance : moving_[i - 1].pp;
  if (observer == Observer::kReference) return {pose, covariance};
  const SecondStation& second = i == 0 ? resting_.second : moving_[i - 1].second;
  const SecondView view(pose, second.pose);
  return {view.pose, seen_covariance(view, covariance, second)};
}

StateEstimate ImmFilter::state_estimate(Observer observer) const {
  StateEstimate b;
  const std::size_t top = most_probable();
  std::array<Seen, kModels> of;
  Vector6 mean = Vector6::Zero();
  std::array<Vector6, kModels> away;
  const double min_counted =
      probability_[kMoving] + probability_[kMoving - 1] < kShaken ? kMinCounted : kMinProbability;
  // The one of highest process noise is always included: gates need it.
  for (std::size_t i = 0; i < kModels; ++i) {
    if (probability_[i] >= min_counted || i == kMoving) of[i] = seen(i, observer);
  }
  for (std::size_t i = 0; i < kModels; ++i) {
    if (probability_[i] < min_counted) continue;
    away[i] = i == top ? Vector6(Vector6::Zero()) : small_difference(of[i].pose, of[top].pose);
    mean += probability_[i] * away[i];
    if (i > 0) b.rate += probability_[i] * moving_[i - 1].rate;
  }
  b.pose = of[top].pose.moved_by(mean);
  for (std::size_t i = 0; i < kModels; ++i) {
    if (probability_[i] < min_counted) continue;
    const Vector6 e = away[i] - mean;
    b.covariance += probability_[i] * (of[i].covariance + e.lazyProduct(e.transpose()));
    Vector6 variance = b.rate.cwiseAbs2();
    if (i > 0) variance = (moving_[i - 1].rate - b.rate).cwiseAbs2() + moving_[i - 1].rr.diagonal();
    b.rotation_rate_variance += probability_[i] * variance.head<3>().sum() / 3.0;
    b.velocity_variance += probability_[i] * variance.tail<3>().sum() / 3.0;
  }
  const Seen& highest_noise = of[kMoving];
  const Vector6 apart = small_difference(highest_noise.pose, b.pose);
  b.gate_covariance = b.covariance + highest_noise.covariance + apart.lazyProduct(apart.transpose());
  if (observer == Observer::kSecond) {
    const Matrix3& turn = second().pose.R;
    b.rate.head<3>() = turn * b.rate.head<3>().eval();
    b.rate.tail<3>() = turn * b.rate.tail<3>().eval();
  }
  return b;
}

template <class State>
void ImmFilter::correct_one(State& state, const SweepInformation& sweep, const Innovation& innovation,
                            Observer observer) {
  if (observer == Observer::kReference) {
    state.correct(sweep, innovation, linked_);
  } else {
    state.correct_second(sweep, innovation, SecondView(state.pose, state.second.pose));
  }
}

double ImmFilter::correct(const SweepInformation& sweep, const LighthouseFromBody& pose, Observer observer) {
  std::array<Innovation, kModels> innovation;
  double minimum = 1e300;
  for (std::size_t i = 0; i < kModels; ++i) {
    const Seen own = seen(i, observer);
    innovation[i] = innovation_of(sweep, own.covariance, small_difference(own.pose, pose));
    minimum = std::min(minimum, innovation[i].chi2 + innovation[i].log_det);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kModels; ++i) {
    probability_[i] *= std::exp(-0.5 * (innovation[i].chi2 + innovation[i].log_det - minimum));
    sum += probability_[i];
  }
  for (std::size_t i = 0; i < kModels; ++i) {
    probability_[i] /= sum;
    probability_[i] = std::max(probability_[i], kMinProbability);
    if (i == 0) {
      correct_one(resting_, sweep, innovation[i], observer);
    } else {
      correct_one(moving_[i - 1], sweep, innovation[i], observer);
    }
  }
  return sweep.residual_chi2 + minimum - 2.0 * std::log(sum);
}

}  // namespace pharos::motion
