// SPDX-License-Identifier: Apache-2.0
// What a hypothesis knows of the tilt of coplanar sensors.
#include <algorithm>
#include <cmath>

#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {
namespace {

// No sweep tells more than this (one in ten million by chance): it is of another motion.
constexpr double kMaxSideChi2 = 40.0;

}  // namespace

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
