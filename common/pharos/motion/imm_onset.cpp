// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/imm_onset.hpp"

namespace pharos::motion {

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

}  // namespace pharos::motion
