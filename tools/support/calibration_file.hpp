// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/calibration_file.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::tools {

/// Calibrations from a file: of stations alone (host/stations), or of a target with its stations (host/calibrate).
class CalibrationFile {
 public:
  /// Throws InputError naming file, line and key.
  explicit CalibrationFile(const std::string& path);

  /// Calibrations of its stations; a view of this object.
  tracking::StationSurvey survey() const;
  const calibrate::CalibrationFile& content() const { return content_; }

 private:
  calibrate::CalibrationFile content_;
};

}  // namespace pharos::tools
