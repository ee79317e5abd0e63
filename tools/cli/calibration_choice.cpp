// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/calibration_choice.hpp"

namespace pharos::tools {

CalibrationChoice::CalibrationChoice(const std::string& choice, const std::string& recording_path)
    : kind_(choice == "ootx"   ? Kind::kOotx
            : choice == "none" ? Kind::kNone
                               : Kind::kFile) {
  if (kind_ == Kind::kFile) file_.emplace(choice);
  stations_ = read_ahead(recording_path);
}

const lighthouse::StationCalibration* CalibrationChoice::calibration(std::uint8_t station) const {
  switch (kind_) {
    case Kind::kOotx:
      return stations_.calibration(station);
    case Kind::kNone:
      return nullptr;
    case Kind::kFile:
      return file_->find(station, stations_.id(station));
  }
  return nullptr;
}

}  // namespace pharos::tools
