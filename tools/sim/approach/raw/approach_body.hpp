// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/render/solid_scene.hpp"
#include "tools/sim/tof/satellite.hpp"

namespace pharos::sim {

/// The satellite of an approach in the frame T of its docking ring: ring, nozzle, connectors, solar wings, and
/// the lighthouse's target. `head` is T_ring_head: where that target's body frame is.
Satellite approach_satellite(const Pose<frame::Target, frame::Body>& head);

/// The same body for cameras that see sunlight, in T. `to_sun` and `fill` are the caller's.
SolidScene sunlit_scene(const Satellite& satellite);

}  // namespace pharos::sim
