// SPDX-License-Identifier: Apache-2.0
#include "tools/support/calibration_choice.hpp"

#include "host/support/input_error.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {

CalibrationChoice::CalibrationChoice(const std::string& choice, const std::string& recording_path)
    : use_sent_(choice == "ootx") {
  if (!use_sent_ && choice != "none") {
    file_.emplace(choice);
    survey_ = file_->survey();
  }
  stations_ = read_ahead(recording_path);
  if (file_ && file_->content().has_target()) require_a_station();
}

tracking::CalibrationPolicy CalibrationChoice::policy() const {
  tracking::CalibrationPolicy policy;
  policy.use_sent = use_sent_;
  policy.survey = file_ ? &survey_ : nullptr;
  return policy;
}

void CalibrationChoice::require_a_station() const {
  std::string seen;
  for (std::uint8_t slot = 0; slot < kMaxStations; ++slot) {
    const std::optional<std::uint32_t> id = stations_.id(slot);
    if (!id) continue;
    if (survey_.find(slot, id) != nullptr) return;
    seen += (seen.empty() ? "" : ", ") + station_id_text(id);
  }
  if (seen.empty()) return;  // not known yet; rows of unknown stations are flagged uncalibrated
  throw host::InputError(file_->content().name + ": a calibration of other stations: " + seen +
                         " of the recording is not in it; give the calibration made with it");
}

Target CalibrationChoice::target(const Target& nominal, lighthouse::ModelForm form) const {
  if (!file_) return nominal;
  const calibrate::CalibrationFile& content = file_->content();
  if (content.model_form != 0 && content.model_form != static_cast<int>(form)) {
    throw host::InputError(content.name + ": calibrated with sign form " + std::to_string(content.model_form) +
                           "; give --form " + std::to_string(content.model_form));
  }
  return calibrate::calibrated_target(content, nominal);
}

motion::SystematicErrors CalibrationChoice::systematic() const {
  return file_ ? calibrate::systematic_errors(file_->content()) : motion::kUncalibratedErrors;
}

void CalibrationChoice::widen(LighthousePoseEstimate& estimate) const {
  if (file_) calibrate::widen_by_scale(estimate, file_->content().scale_sigma);
}

}  // namespace pharos::tools
