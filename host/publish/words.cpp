// SPDX-License-Identifier: Apache-2.0
#include "host/publish/words.hpp"

#include <array>
#include <cstdio>

#include "host/support/flag_text.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {

std::string status_word(const Result<LighthousePoseEstimate, pose::Refusal>& pose) {
  if (!pose) return std::string("refused_") + pose::name_of(pose.error());
  return pose->ambiguous() ? "ambiguous" : "ok";
}

std::string flag_words(std::uint8_t epoch_flags) { return joined_flags(epoch_flags, track::kEpochFlagWords); }

std::string flag_words(const CycleReport& report) {
  std::string words = flag_words(report.flags);
  if (report.clock_was_set) words += words.empty() ? "clock_set" : "|clock_set";
  return words;
}

std::string station_id_text(std::uint32_t id) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08X", id);
  return text.data();
}

}  // namespace pharos::host
