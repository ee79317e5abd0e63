// SPDX-License-Identifier: Apache-2.0
#include "tools/support/calibration_file.hpp"

#include "host/support/input_error.hpp"

namespace pharos::tools {

CalibrationFile::CalibrationFile(const std::string& path) : content_(calibrate::read_calibration_file(path)) {
  if (!content_.stations.empty()) return;
  throw host::InputError(path + ": no [[station]] in the file; give one a station (see tools/README.md)");
}

tracking::StationSurvey CalibrationFile::survey() const {
  return {content_.stations, content_.pair ? &*content_.pair : nullptr};
}

}  // namespace pharos::tools
