// SPDX-License-Identifier: Apache-2.0
#include "host/publish/words.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {

std::string status_word(const Result<LighthousePoseEstimate, pose::Refusal>& pose) {
  if (!pose) return std::string("refused_") + pose::name_of(pose.error());
  return pose->ambiguous() ? "ambiguous" : "ok";
}

std::string flag_words(std::uint8_t epoch_flags) {
  constexpr std::array<std::pair<track::EpochFlag, const char*>, 6> kWords{{
      {track::kEpochUncalibrated, "uncalibrated"},
      {track::kEpochFlashWeak, "flash_weak"},
      {track::kEpochPeriodNominal, "period_nominal"},
      {track::kEpochOutliers, "outliers"},
      {track::kEpochPrior, "prior"},
      {track::kEpochLockPoor, "lock_poor"},
  }};
  std::string words;
  for (const auto& [flag, word] : kWords) {
    if ((epoch_flags & flag) == 0) continue;
    if (!words.empty()) words += '|';
    words += word;
  }
  return words;
}

std::string station_id_text(std::uint32_t id) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08X", id);
  return text.data();
}

}  // namespace pharos::host
