// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/network/station.hpp"

namespace pharos::host {

/// Reads the stations of a room (README.md shows a file; `-` is standard input): [[station]] tables with number,
/// generation, id, calibration, and position_m and rotation_wxyz (T_world_station) where they are known. Throws
/// InputError naming file, line and key: a number twice, more than 16 stations, an angle that no station has, a pose of
/// which half is missing, an unknown key.
network::Stations read_network_file(const std::string& path);

/// The text of such a file: read_network_file reads the same values from it.
std::string network_text(const network::Stations& stations);

}  // namespace pharos::host
