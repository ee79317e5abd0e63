// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::tools {

/// Station calibrations from a TOML file, one [[station]] each:
///
///   [[station]]
///   id = "BEC08E38"                            # as the station's OOTX says, or
///   slot = 0                                   # the station in this slot position, whatever its id
///   phase_rad = [0.015587, 0.038208]           # rotor x, rotor y
///   tilt_rad = [0.000298, 0.002243]            # absent lists are zero
///   curve_rad = [-0.001802, -0.001709]
///   gibbous_phase_rad = [-0.32666, -1.50781]
///   gibbous_magnitude_rad = [0.0042496, -0.0057602]
class CalibrationFile {
 public:
  /// Throws InputError naming file, line and key.
  explicit CalibrationFile(const std::string& path);

  /// The entry for this slot position, else the one for this id; null where the file has neither.
  const lighthouse::StationCalibration* find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const;

 private:
  struct Entry {
    std::optional<std::uint8_t> slot;
    lighthouse::StationCalibration calibration;
  };
  std::vector<Entry> entries_;
};

}  // namespace pharos::tools
