// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "tools/sim/approach/approach_scenario.hpp"
#include "tools/sim/trajectory.hpp"

namespace pharos::sim {

/// The target's true motion in the vehicle's frame.
///
/// An approach: distance d with d' = -(k d + v), v = 5 mm/s, so that speed falls with the distance; the centre of mass
/// sways across; the body is a symmetric top free of torque (Euler: precession L / I_t about the angular momentum, spin
/// L cos(nutation) (1 / I_a - 1 / I_t) about its own axis); the vehicle sways in attitude.
class ApproachTruth {
 public:
  ApproachTruth(const ApproachMotion& motion, std::uint64_t seed);

  host::VehicleFromTarget at(double time_s) const;

  struct Rates {
    Vector3 velocity_m_s;  // of the target frame's origin, in the vehicle frame
    Vector3 rate_rad_s;    // of the target relative to the vehicle, in the vehicle frame
  };
  Rates rates(double time_s) const;

 private:
  double distance_m(double time_s) const;
  host::VehicleFromTarget approach(double time_s) const;
  host::VehicleFromTarget manoeuvre(double time_s) const;

  ApproachMotion motion_;
  double decay_per_s_ = 0.0;
  double precession_rad_s_ = 0.0, spin_rad_s_ = 0.0;
  double precession_phase_rad_ = 0.0, spin_phase_rad_ = 0.0;
  std::array<Sine, 6> sway_;              // of the position, two an axis, amplitude 1
  std::array<Sine, 6> turn_;              // of a manoeuvre's rotation vector
  std::array<Sine, 3> vehicle_sway_rad_;  // rotation vector
};

}  // namespace pharos::sim
