// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// Sensors on a target of 0.2 m before one or two Lighthouse 2.0 stations, swaying at 2.3 m.
inline LighthouseScenario lh2_scene(double duration_s, int stations = 1) {
  LighthouseScenario scenario;
  scenario.generation = 2;
  scenario.duration_s = duration_s;
  for (int i = 0; i < 8; ++i) {
    const double around = kTwoPi * i / 8.0;
    scenario.target.push_back({static_cast<std::uint8_t>(i),
                               Vector3(0.1 * std::cos(around), 0.1 * std::sin(around), i % 2 == 0 ? 0.0 : 0.05),
                               Vector3::Zero()});
  }
  StationScenario station;
  station.channel = 6;
  station.calibration.reset();
  scenario.stations.push_back(station);
  if (stations == 2) {
    station.channel = 1;
    station.id = 0xC33B4DE1;
    station.pose = {rotation_exp(Vector3(0.0, -kPi / 4, 0.0)), Vector3(1.6, 0.0, 0.8)};
    scenario.stations.push_back(station);
  }
  const Sine sway{0.2, 0.4, 0.0};
  scenario.trajectory =
      std::make_shared<SineTrajectory>(RoomFromBody{rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.1, 0.0, 2.3)},
                                       std::array{sway, sway, sway}, std::array<Sine, 3>{}, 40.0 * kRadPerDeg);
  return scenario;
}

}  // namespace pharos::sim
