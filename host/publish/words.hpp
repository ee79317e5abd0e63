// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/publish/cycle_report.hpp"
#include "pharos/base/result.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::host {

/// "ok", "ambiguous" or "refused_<reason>": the `status` of tables and messages.
std::string status_word(const Result<LighthousePoseEstimate, pose::Refusal>& pose);

/// Words of track::EpochFlag joined by '|', "" for none: the `flags` of tables and messages.
std::string flag_words(std::uint8_t epoch_flags);
/// The same of a message, with `clock_set` where this computer's clock was set.
std::string flag_words(const CycleReport& report);

/// A station's OOTX id as eight hex digits in capitals, as it stands on its label.
std::string station_id_text(std::uint32_t id);

}  // namespace pharos::host
