// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/cli/calibration_file.hpp"
#include "tools/cli/stations.hpp"

namespace pharos::tools {

/// Where `track` takes the stations' calibrations from: `ootx`, `none` or a file (--calibration).
class CalibrationChoice {
 public:
  /// For `ootx` (and for a file that names stations by id) a recording that can be read twice is read ahead.
  CalibrationChoice(const std::string& choice, const std::string& recording_path);

  /// What the recording says as it goes on.
  void push(const lighthouse::OotxPayload& payload) { stations_.push(payload); }
  /// After a long dark: the stations may stand in other slots.
  void forget_stations() { stations_.forget(); }
  /// The calibration that holds now; null for none.
  const lighthouse::StationCalibration* calibration(std::uint8_t station) const;
  std::optional<std::uint32_t> station_id(std::uint8_t station) const { return stations_.id(station); }

 private:
  enum class Kind : std::uint8_t { kOotx, kNone, kFile };
  Kind kind_;
  std::optional<CalibrationFile> file_;
  Stations stations_;
};

}  // namespace pharos::tools
