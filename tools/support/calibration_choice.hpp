// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/support/calibration_file.hpp"
#include "tools/support/stations.hpp"

namespace pharos::tools {

/// Where `track` takes the calibrations of stations and target from: `ootx`, `none` or a file (--calibration).
class CalibrationChoice {
 public:
  /// For `ootx` (and for a file that names stations by id) a recording that can be read twice is read ahead. Throws
  /// InputError for a calibrated file (host/calibrate) of none of the stations that the recording names.
  CalibrationChoice(const std::string& choice, const std::string& recording_path);

  /// What the recording says as it goes on.
  void push(const lighthouse::OotxPayload& payload) { stations_.push(payload); }
  /// After a long dark: the stations may stand in other slots.
  void forget_stations() { stations_.forget(); }
  /// The calibration that holds now; null for none.
  const lighthouse::StationCalibration* calibration(std::uint8_t station) const;
  /// The target with the file's sensor positions; `nominal` where none are given. Throws InputError where the file was
  /// made of another target or with another sign form.
  Target target(const Target& nominal, lighthouse::ModelForm form) const;
  /// Where slot 1's station stands to slot 0's: of a file that knows both, once both are known by name.
  std::optional<motion::StationRelative> relative() const;
  /// What nobody knows of sensors and rotors.
  motion::SystematicErrors systematic() const;
  /// Widens a pose's covariance by what is not known of the target's size.
  void widen(LighthousePoseEstimate& estimate) const;
  std::optional<std::uint32_t> station_id(std::uint8_t station) const { return stations_.id(station); }

 private:
  void require_a_station() const;

  enum class Kind : std::uint8_t { kOotx, kNone, kFile };
  Kind kind_;
  std::optional<CalibrationFile> file_;
  Stations stations_;
};

}  // namespace pharos::tools
