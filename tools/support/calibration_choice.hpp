// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pharos/tracking/calibrated_tracker.hpp"
#include "tools/support/calibration_file.hpp"
#include "tools/support/stations.hpp"

namespace pharos::tools {

/// Source of the calibrations of stations and target for `track`: `ootx`, `none` or a file (--calibration).
class CalibrationChoice {
 public:
  /// For `ootx` (and for a file that names stations by id) a recording that can be read twice is read ahead. Throws
  /// InputError for a calibration (host/calibrate) that contains none of the recording's stations.
  CalibrationChoice(const std::string& choice, const std::string& recording_path);
  CalibrationChoice(const CalibrationChoice&) = delete;
  CalibrationChoice& operator=(const CalibrationChoice&) = delete;

  /// The calibrations for the tracker; points into this object.
  tracking::CalibrationPolicy policy() const;
  /// OOTX of the recording's stations, read ahead.
  const lighthouse::CalibrationStore& sent_ahead() const { return stations_.store(); }
  /// The target with the file's sensor positions; `nominal` where none are given. Throws InputError where the file is
  /// of another target or another sign form.
  Target target(const Target& nominal, lighthouse::ModelForm form) const;
  /// Remaining systematic errors of sensors and rotors.
  motion::SystematicErrors systematic() const;
  /// Increases a pose's covariance by the uncertainty of the target's size.
  void widen(LighthousePoseEstimate& estimate) const;

 private:
  void require_a_station() const;

  bool use_sent_;
  std::optional<CalibrationFile> file_;
  tracking::StationSurvey survey_;  // of the file
  Stations stations_;
};

}  // namespace pharos::tools
