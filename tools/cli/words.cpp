// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/words.hpp"

#include <array>

#include "pharos/lighthouse/sweep.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tools {
namespace {

constexpr std::array kSweepWords = {
    FlagWord{lighthouse::kSweepPeriodNominal, "period_nominal"},
    FlagWord{lighthouse::kSweepFlashWeak, "flash_weak"},
    FlagWord{lighthouse::kSweepLockPoor, "lock_poor"},
};

constexpr std::array kEpochWords = {
    FlagWord{track::kEpochUncalibrated, "uncalibrated"},
    FlagWord{track::kEpochFlashWeak, "flash_weak"},
    FlagWord{track::kEpochPeriodNominal, "period_nominal"},
    FlagWord{track::kEpochOutliers, "outliers"},
    FlagWord{track::kEpochPrior, "prior"},
    FlagWord{track::kEpochLockPoor, "lock_poor"},
};

char hex_digit(unsigned value, bool upper) { return (upper ? "0123456789ABCDEF" : "0123456789abcdef")[value & 15u]; }

}  // namespace

std::string joined_flags(unsigned flags, std::span<const FlagWord> words) {
  std::string text;
  for (const FlagWord& flag : words) {
    if ((flags & flag.bit) == 0) continue;
    if (!text.empty()) text += '|';
    text += flag.word;
  }
  return text;
}

std::string sweep_flag_words(unsigned flags) { return joined_flags(flags, kSweepWords); }
std::string epoch_flag_words(unsigned flags) { return joined_flags(flags, kEpochWords); }

std::string station_id_text(const std::optional<std::uint32_t>& id) {
  std::string text;
  if (!id) return text;
  for (unsigned shift = 32; shift > 0;) {
    shift -= 4;
    text += hex_digit(*id >> shift, true);
  }
  return text;
}

std::string hex_text(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += hex_digit(byte / 16u, false);
    text += hex_digit(byte, false);
  }
  return text;
}

}  // namespace pharos::tools
