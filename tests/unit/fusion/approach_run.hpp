// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "host/fusion/target_fuser.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tools/sim/approach/approach_simulator.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::tests {

inline constexpr double kFiveSigmas_chi2 = 35.0;  // chi-squared of three: 1e-7

/// A valid fused state beside the truth.
struct ApproachLook {
  double time_s = 0.0;
  fusion::TargetState state;
  double rotation_rad = 0.0, position_m = 0.0;      // errors
  double rotation_chi2 = 0.0, position_chi2 = 0.0;  // their squares in the state's own covariance, three each
  double nees = 0.0;                                // of the pose, over six

  bool told_as_sound() const { return state.mode == fusion::Mode::kSingle || state.mode == fusion::Mode::kFused; }
  bool beyond_five_sigmas() const { return std::max(rotation_chi2, position_chi2) > kFiveSigmas_chi2; }
  /// Beyond five of its own sigmas and beyond 1 deg or 10 mm.
  bool far_off() const {
    return (rotation_chi2 > kFiveSigmas_chi2 && rotation_rad > kRadPerDeg) ||
           (position_chi2 > kFiveSigmas_chi2 && position_m > 0.01);
  }
  bool outside_level() const {
    const fusion::ProtectionLevel& level = state.protection;
    return (level.rotation_available && rotation_rad > level.rotation_rad) ||
           (level.position_available && position_m > level.position_m);
  }
  bool excludes(std::size_t source) const { return state.sources[source].state == fusion::SourceState::kExcluded; }
};

inline sim::ApproachScenario approach_scenario(const std::string& name) {
  return sim::read_approach_scenario(std::string(PHAROS_SCENARIOS) + "/approach_" + name + ".toml");
}

/// The scenario `faults` with eight others: any source and kind, at any time from `from_s` on, some at the same time.
inline sim::ApproachScenario with_random_faults(std::uint64_t seed, double from_s) {
  using Kind = sim::ApproachFaultKind;
  constexpr double kKinds = 8.0;
  sim::ApproachScenario scenario = approach_scenario("faults");
  scenario.faults.clear();
  sim::RandomStream random(seed, "random faults");
  for (int i = 0; i < 8; ++i) {
    sim::ApproachFault fault;
    const double source = random.uniform(0.0, static_cast<double>(scenario.sources.size()));
    fault.source = scenario.sources[static_cast<std::size_t>(source)].name;
    fault.kind = static_cast<Kind>(static_cast<int>(random.uniform(0.0, kKinds)));
    fault.at_low_s = fault.at_high_s = random.uniform(from_s, 285.0);
    fault.for_s = random.uniform(4.0, 20.0);
    fault.ramp_s = random.uniform(3.0, 20.0);
    const double most = fault.kind == Kind::kWrongTime ? 0.5 : fault.kind == Kind::kScale ? 0.05 : 30.0;
    const double least = most < 3.0 ? -most : 3.0;
    fault.amount_low = fault.amount_high = random.uniform(least, most);
    scenario.faults.push_back(fault);
  }
  return scenario;
}

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
