// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::calibrate {

/// Poses of all stations from the recording alone: positions of the body that each station tells (pose::solve, whose
/// two minima of a flat target stand at nearly the same place), aligned rigidly where two stations see it at once, from
/// one station to the next by most common instants. The first station keeps its pose, or stands at the world's origin.
///
/// Good to some centimetres. Throws host::InputError where stations have fewer than 30 instants in common or the
/// target was carried along a line only.
void start_stations(const std::vector<network::PlaneSweep>& sweeps, const Target& target, const std::string& name,
                    network::Stations& stations);

}  // namespace pharos::calibrate
