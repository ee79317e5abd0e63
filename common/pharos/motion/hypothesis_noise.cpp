// SPDX-License-Identifier: Apache-2.0
// The noise of a hypothesis' hits as its sweeps show it, and the errors that do not average out in them.
#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {
namespace {

// Degrees of freedom that the estimated own variance averages over.
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

}  // namespace

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
void Hypothesis::add_systematics(StateEstimate& state_estimate, Observer observer) const {
  const Matrix6 systematic = systematic_of(observer);
  state_estimate.covariance += systematic;
  state_estimate.gate_covariance += systematic;
}

bool Hypothesis::noise_implausible() const { return station_state(observer_).level >= kMaxLevel; }

double Hypothesis::noise_scale(Observer observer) const { return std::sqrt(station_state(observer).level); }

}  // namespace pharos::motion
