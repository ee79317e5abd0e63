// SPDX-License-Identifier: Apache-2.0
#include "tools/support/calibration_file.hpp"

#include "host/support/input_error.hpp"

namespace pharos::tools {

CalibrationFile::CalibrationFile(const std::string& path) : content_(calibrate::read_calibration_file(path)) {
  if (!content_.stations.empty()) return;
  throw host::InputError(path + ": no [[station]] in the file; give one a station (see tools/README.md)");
}

const lighthouse::StationCalibration* CalibrationFile::find(std::uint8_t slot,
                                                            const std::optional<std::uint32_t>& id) const {
  for (const host::StationEntry& entry : content_.stations) {
    if (entry.slot == slot) return &entry.calibration;
  }
  for (const host::StationEntry& entry : content_.stations) {
    if (!entry.slot && id && entry.id == id) return &entry.calibration;
  }
  return nullptr;
}

}  // namespace pharos::tools
