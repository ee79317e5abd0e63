// SPDX-License-Identifier: Apache-2.0
// What a hypothesis knows of the tilt of coplanar sensors.
#include <cmath>

#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {

void Hypothesis::see_tilt() {
  tilt_.reset();
  if (diverged_ || fit_.used.size() < static_cast<std::size_t>(kMinSensorsToJudge)) return;
  tilt_ = Tilt::of(fit_, plane_, state_estimate_.pose);
  sweeps_with_relief_ = tilt_ ? 0 : sweeps_with_relief_ + 1;
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
