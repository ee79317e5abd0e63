// SPDX-License-Identifier: Apache-2.0
#include "tools/support/words.hpp"

#include "host/support/flag_text.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::tools {
namespace {

char hex_digit(unsigned value, bool upper) { return (upper ? "0123456789ABCDEF" : "0123456789abcdef")[value & 15u]; }

}  // namespace

std::string sweep_flag_words(unsigned flags) { return host::joined_flags(flags, lighthouse::kSweepFlagWords); }
std::string epoch_flag_words(unsigned flags) { return host::joined_flags(flags, track::kEpochFlagWords); }

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
