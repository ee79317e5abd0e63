// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/stations/station_file.hpp"

namespace pharos::tools {

/// Station calibrations from a file in the form of host/stations.
class CalibrationFile {
 public:
  /// Throws InputError naming file, line and key.
  explicit CalibrationFile(const std::string& path);

  /// The entry for this slot position, else the one for this id; null where the file has neither.
  const lighthouse::StationCalibration* find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const;

 private:
  std::vector<host::StationEntry> entries_;
};

}  // namespace pharos::tools
