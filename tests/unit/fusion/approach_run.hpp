// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "host/fusion/target_fuser.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tools/sim/approach/approach_simulator.hpp"

namespace pharos::tests {

/// A valid fused state beside the truth.
struct ApproachLook {
  double time_s = 0.0;
  fusion::TargetState state;
  double rotation_rad = 0.0, position_m = 0.0;      // errors
  double rotation_chi2 = 0.0, position_chi2 = 0.0;  // their squares in the state's own covariance, three each
  double nees = 0.0;                                // of the pose, over six

  bool told_as_sound() const { return state.mode == fusion::Mode::kSingle || state.mode == fusion::Mode::kFused; }
};

/// Fuses a simulated approach as `pharos fuse` does and calls `look` twenty times a second with valid states.
template <class Look>
void fuse_approach(const sim::ApproachSimulator& simulator, const host::FusionChoices& choices, Look look) {
  host::TargetFuser fuser(simulator.calibrated_mounting().sources, choices);
  constexpr double kStep_s = 0.05;
  double next_s = 0.0;
  for (const sim::ApproachMeasurement& m : simulator.measure_all()) {
    for (; next_s < m.arrival_s; next_s += kStep_s) {
      ApproachLook at{next_s, fuser.state(std::llround(next_s * 1e9)), 0, 0, 0, 0, 0};
      if (!at.state.valid) continue;
      const host::VehicleFromTarget truth = simulator.truth().at(next_s);
      const Vector6 error = pose_difference(fusion::TargetPose{truth.R, truth.t}, at.state.kinematics.pose);
      const Matrix6 P = at.state.covariance.topLeftCorner<6, 6>();
      const Matrix3 P_rotation = P.topLeftCorner<3, 3>();
      const Matrix3 P_position = P.bottomRightCorner<3, 3>();
      const Vector3 rotation = error.head<3>();
      const Vector3 position = error.tail<3>();
      at.rotation_rad = rotation.norm();
      at.position_m = position.norm();
      at.rotation_chi2 = mahalanobis_squared<3>(rotation, P_rotation);
      at.position_chi2 = mahalanobis_squared<3>(position, P_position);
      at.nees = mahalanobis_squared<6>(error, P) / 6.0;
      look(at);
    }
    if (!m.seen) continue;
    fuser.push(m.source, {m.time_s, m.arrival_s, m.pose, m.covariance, m.has_turn, 0.0F, m.second, m.delta_chi2});
  }
}

}  // namespace pharos::tests
