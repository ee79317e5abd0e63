// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/calibrate/stations/station_calibration.hpp"

namespace pharos::calibrate {

/// A room with two stations and a small flat target that a hand carries. Angles by formulas of its own: ideal planes,
/// less a phase.
struct SimulatedRoom {
  network::Generation generation = network::Generation::kLighthouse1;
  network::Stations truth;  // with the true phases
  Target target;
  /// How light from aside makes a flat target look larger along its direction: by this times the squared tangent.
  double stretch_from_aside = 0.0;

  /// Hits from `begin_s` on; `moving`: how much of the motion, 1 = all of it, 0 = at rest.
  NetworkLog record(double seconds, double moving, std::uint32_t seed) const;
  /// Where the body is.
  static network::WorldFromBody body_at(double time_s, double moving);
};

SimulatedRoom simulated_room(network::Generation generation);

}  // namespace pharos::calibrate
