// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/calibrate/calibration_file.hpp"

namespace pharos::tools {

/// Calibrations from a file: of stations alone (host/stations), or of a target with its stations (host/calibrate).
class CalibrationFile {
 public:
  /// Throws InputError naming file, line and key.
  explicit CalibrationFile(const std::string& path);

  /// The entry for this slot position, else the one for this id; null where the file has neither.
  const lighthouse::StationCalibration* find(std::uint8_t slot, const std::optional<std::uint32_t>& id) const;
  const calibrate::CalibrationFile& content() const { return content_; }

 private:
  calibrate::CalibrationFile content_;
};

}  // namespace pharos::tools
