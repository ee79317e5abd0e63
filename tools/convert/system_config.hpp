// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/network/station.hpp"

namespace pharos::convert {

/// Reads a Crazyflie's lighthouse system configuration (YAML): `systemType` (1 or 2), `calibs` (OOTX fields of both
/// sweeps) and `geos` (origin, rotation matrix of x ahead, y left, z up in the world) by base station. A station
/// without geometry has no pose. `name` stands for the file in messages.
///
/// Throws InputError of one line: not YAML, not such a file, a missing or wrong field, a matrix that is no rotation.
network::Stations read_system_config(const std::string& text, const std::string& name);

}  // namespace pharos::convert
