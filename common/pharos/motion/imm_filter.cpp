// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/imm_filter.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/small_difference.hpp"
#include "pharos/motion/imm_onset.hpp"
#include "pharos/motion/state_mixture.hpp"

namespace pharos::motion {
namespace {

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

// No model becomes less probable. One that is hardly more probable is no part of the mixture of a steady body: the
// static model, whose covariance hardly lets it follow a body that moves on, runs away by kilometres in a second. Of a
// shaken body all models are, as its gates have room for a hand.
constexpr double kMinProbability = 1e-9, kMinCounted = 1e-8;

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

ImmFilter::Views ImmFilter::own_views() const {
  Views views;
  for (std::size_t i = 0; i < kModels; ++i) {
    views.pose[i] = i == 0 ? &resting_.pose : &moving_[i - 1].pose;
    views.covariance[i] = i == 0 ? &resting_.covariance : &moving_[i - 1].pp;
  }
  return views;
}

ImmFilter::Seen ImmFilter::seen_by_second(std::size_t i) const {
  const SecondStation& second = i == 0 ? resting_.second : moving_[i - 1].second;
  const SecondView view(i == 0 ? resting_.pose : moving_[i - 1].pose, second.pose);
  return {view.pose, seen_covariance(view, i == 0 ? resting_.covariance : moving_[i - 1].pp, second)};
}

StateEstimate ImmFilter::state_estimate(Observer observer) const {
  Views views = own_views();
  const double min_counted = steady() ? kMinCounted : kMinProbability;
  if (observer == Observer::kReference) return moments(views, min_counted);
  std::array<Seen, kModels> seen;
  for (std::size_t i = 0; i < kModels; ++i) {
    // The one of highest process noise is always included: gates need it.
    if (probability_[i] < min_counted && i != kMoving) continue;
    seen[i] = seen_by_second(i);
    views.pose[i] = &seen[i].pose;
    views.covariance[i] = &seen[i].covariance;
  }
  StateEstimate b = moments(views, min_counted);
  const Matrix3& turn = second().pose.R;
  b.rate.head<3>() = turn * b.rate.head<3>().eval();
  b.rate.tail<3>() = turn * b.rate.tail<3>().eval();
  return b;
}

// Of the mixture of the models that are no less probable than `min_counted`.
[[gnu::flatten]] StateEstimate ImmFilter::moments(const Views& of, double min_counted) const {
  StateEstimate b;
  const std::size_t top = most_probable();
  Vector6 mean = Vector6::Zero();
  std::array<Vector6, kModels> away;
  for (std::size_t i = 0; i < kModels; ++i) {
    if (probability_[i] < min_counted) continue;
    away[i] = i == top ? Vector6(Vector6::Zero()) : small_difference(*of.pose[i], *of.pose[top]);
    mean += probability_[i] * away[i];
    if (i > 0) b.rate += probability_[i] * moving_[i - 1].rate;
  }
  b.pose = of.pose[top]->moved_by(mean);
  for (std::size_t i = 0; i < kModels; ++i) {
    if (probability_[i] < min_counted) continue;
    const Vector6 e = away[i] - mean;
    b.covariance += probability_[i] * (*of.covariance[i] + e.lazyProduct(e.transpose()));
    Vector6 variance = b.rate.cwiseAbs2();
    if (i > 0) variance = (moving_[i - 1].rate - b.rate).cwiseAbs2() + moving_[i - 1].rr.diagonal();
    b.rotation_rate_variance += probability_[i] * variance.head<3>().sum() / 3.0;
    b.velocity_variance += probability_[i] * variance.tail<3>().sum() / 3.0;
  }
  const Vector6 apart = small_difference(*of.pose[kMoving], b.pose);
  b.gate_covariance = b.covariance + *of.covariance[kMoving] + apart.lazyProduct(apart.transpose());
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
  const Views own = own_views();
  for (std::size_t i = 0; i < kModels; ++i) {
    if (observer == Observer::kReference) {
      innovation[i] = innovation_of(sweep, *own.covariance[i], small_difference(*own.pose[i], pose));
    } else {
      const Seen seen = seen_by_second(i);
      innovation[i] = innovation_of(sweep, seen.covariance, small_difference(seen.pose, pose));
    }
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
