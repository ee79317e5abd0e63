// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/random_stream.hpp"
#include "tools/sim/tof/random_body.hpp"

namespace pharos::sim {

/// Place of a box' centre in T.
Vector2 place_of(const Connector& box);

/// Whether a disc of `reach_m` about a place of the face is on it, and clear of nozzle, ring, connectors and clutter.
bool is_free(const Satellite& satellite, const Vector2& place_m, double reach_m);

/// What looks like ring and connectors, or stands before them: a second ring, a groove about the same axis, square
/// covers, thrusters, a dish beside the body, a thin boom over the face.
void add_clutter(RandomTofBody& body, RandomStream random);

}  // namespace pharos::sim
