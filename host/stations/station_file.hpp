// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pharos/lighthouse/station_calibration.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::host {

class TomlTable;

/// One [[station]] of a station file.
using StationEntry = tracking::KnownStation;

/// Reads a station file (README.md shows one; `-` is standard input). Throws InputError naming file, line and key for
/// an invalid one: an entry without id and slot, an unknown key, an angle that no station has.
std::vector<StationEntry> read_station_file(const std::string& path);

/// A station's identity under `key`, in hexadecimal as printed on it.
std::uint32_t read_station_id(const TomlTable& table, std::string_view key);

/// The [[station]] tables of a file that contains other tables too.
std::vector<StationEntry> read_stations(const TomlTable& root);

/// Whether read_station_file accepts the text of station_text: a received value may be finite and still not an angle of
/// any station.
bool is_plausible(const lighthouse::StationCalibration& station);

/// One [[station]] by id; read_station_file reads the same values from it.
std::string station_text(const lighthouse::StationCalibration& station);

}  // namespace pharos::host
