// SPDX-License-Identifier: Apache-2.0
#pragma once

// Four coplanar sensors alone, seen nearly from straight ahead, whose tilt passes zero.

#include "tests/unit/motion/flight.hpp"

namespace pharos::test {

/// Position and attitude of a plate that faces the station from 3 to 4 m, off its axis.
inline sim::RoomFromBody facing_plate(sim::RandomStream& random) {
  const double range_m = random.uniform(3.0, 4.2);
  const double across = random.uniform(-0.3, 0.3), down = random.uniform(-0.3, 0.3);
  sim::RoomFromBody pose;
  pose.t = range_m * Vector3(std::tan(across), std::tan(down), 1.0).normalized();
  pose.R.col(2) = -pose.t.normalized();
  pose.R.col(0) = Vector3::UnitY().cross(pose.R.col(2)).normalized();
  pose.R.col(1) = pose.R.col(2).cross(pose.R.col(0));
  pose.R = pose.R * rotation_exp({0.0, 0.0, random.uniform(0.0, 2.0 * kPi)});
  return pose;
}

/// Five seconds of a plate that begins 4 to 9 deg to one side and goes to the other one, straight or past zero.
inline sim::LighthouseScenario tilting_plate(std::uint64_t seed) {
  sim::LighthouseScenario scenario = flight_scenario(5.0);
  scenario.target = top_plate_target();
  sim::RandomStream random(seed, "tilt");
  const sim::RoomFromBody centre = facing_plate(random);
  std::array<sim::Sine, 3> position_m, rotation_rad;
  for (sim::Sine& sine : position_m) {
    sine = {random.uniform(0.02, 0.2), random.uniform(0.05, 0.2), random.uniform(0.0, 2.0 * kPi)};
  }
  const double direction = random.uniform(0.0, 2.0 * kPi), tilt_rad = random.uniform(4.0, 9.0) * kRadPerDeg;
  const double frequency_hz = random.uniform(0.08, 0.2);
  rotation_rad[0] = {tilt_rad * std::cos(direction), frequency_hz, kPi / 2.0};
  rotation_rad[1] = {tilt_rad * std::sin(direction), frequency_hz, kPi / 2.0};
  rotation_rad[2] = {random.uniform(0.0, 0.3), random.uniform(0.05, 0.2), random.uniform(0.0, 2.0 * kPi)};
  if (random.uniform(0.0, 1.0) < 0.5) rotation_rad[0].phase_rad += random.uniform(-0.5, 0.5);
  scenario.trajectory = std::make_shared<sim::SineTrajectory>(centre, position_m, rotation_rad, 0.0);
  return scenario;
}

}  // namespace pharos::test
