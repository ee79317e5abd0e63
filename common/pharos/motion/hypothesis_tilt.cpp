// SPDX-License-Identifier: Apache-2.0
// What a hypothesis knows of the tilt of coplanar sensors.
#include <algorithm>
#include <cmath>

#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {
namespace {

// No sweep tells more than this (one in ten million by chance): it is of another motion.
constexpr double kMaxSideChi2 = 40.0;

// Coplanar sensors whose attitude is known no better than this may be tilted to the other side as well. After a start
// only the tilt itself speaks for the side (0.03 rad about each of two axes), later the motion before does too; and the
// hypothesis of the other side, which is not followed before a station of unknown calibration.
constexpr double kMaxTiltAtStart_rad = 0.042, kMaxTilt_rad = 2.0 * kTiltAlone_rad;

}  // namespace

// Mirrored, coplanar sensors fit as well. Sensors with relief tell the side, once each rotor has seen them: one alone
// makes the attitude certain about its own axis, and leaves an error about the other that the stated sigma no longer
// holds.
void Hypothesis::judge_tilt(bool both_sides_followed) {
  tilt_unknown_ = false;
  if (fit_.used.empty() || !filter_.steady()) return;
  if (!coplanar_) {
    if (++sweeps_of_relief_ >= kOneOfEachRotor) side_doubtful_ = false;
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

void Hypothesis::see_tilt() {
  tilt_.reset();
  if (diverged_ || fit_.used.size() < static_cast<std::size_t>(kMinSensorsToJudge)) return;
  tilt_ = Tilt::of(fit_, plane_, state_estimate_.pose);
  sweeps_with_relief_ = tilt_ ? 0 : sweeps_with_relief_ + 1;
}

double Hypothesis::side_cost(const AssumedNoise& noise) const {
  if (fit_.used.size() < static_cast<std::size_t>(kMinSensorsToJudge)) return 0.0;
  const SweepInformation told =
      plane_.holds_all ? perspective_of(fit_, plane_, noise.systematic.sensor_position_m / fit_.pose.t.norm())
                       : fit_.information;
  const Innovation innovation = innovation_of(told, predicted_covariance_, predicted_offset_);
  return std::min(innovation.chi2 + told.residual_chi2, kMaxSideChi2) + innovation.log_det;
}

double Hypothesis::mirrored_apart() const {
  return std::sqrt(tilt_->apart_square(state_estimate_.covariance.topLeftCorner<3, 3>()));
}

bool Hypothesis::tilt_is_loose() const {
  return tilt_ && state_estimate_.covariance.topLeftCorner<3, 3>().trace() > kLinear_rad * kLinear_rad;
}

Matrix6 Hypothesis::second_order() const {
  if (!tilt_is_loose()) return Matrix6::Zero();
  return tilt_->second_order(state_estimate_.pose, state_estimate_.covariance.topLeftCorner<3, 3>());
}

bool Hypothesis::is_nearer_than_mirrored(const LighthouseFromBody& pose) const {
  const LighthouseFromBody& own = state_estimate_.pose;
  return rotation_angle_between(pose.R, own.R) < rotation_angle_between(pose.R, tilt_->mirrored(own).R);
}

Hypothesis Hypothesis::mirrored() const {
  Hypothesis other = *this;
  other.filter_.mirror(*tilt_);
  other.state_estimate_ = other.with_systematics(other.filter_, observer_);
  return other;
}

}  // namespace pharos::motion
