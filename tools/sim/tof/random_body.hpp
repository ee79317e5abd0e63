// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {

/// A body of its own before a camera of its own, in one pose: ring, foil, nozzle, connectors, what looks like them,
/// what stands before them, lens and noise are drawn at random.
struct RandomTofBody {
  TofScenario scenario;
  std::shared_ptr<const PixelRays> rays;  ///< of the scenario's lens
  int connectors = 0;                     ///< of one kind, the first the nearest to the ring's centre by 2 cm
  // What the rule of availability looks at.
  double ring_seen = 0.0;        ///< fraction of the ring's face that nothing hides
  double connectors_seen = 0.0;  ///< the same of the tops of the connectors, the least
  double connector_px = 0.0;     ///< how long a connector's side looks, the least
  double range_m = 0.0;
  bool has_twin = false;        ///< a second ring of a docking ring's size: nobody can tell which is meant
  bool has_look_alike = false;  ///< a square cover, thruster or small ring stands on the face as a connector does
};
RandomTofBody random_tof_body(std::uint64_t seed);
/// Its camera, with the noise of the same seed.
TofSimulator simulator_of(const RandomTofBody& body, std::uint64_t seed);

}  // namespace pharos::sim
