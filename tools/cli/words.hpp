// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace pharos::tools {

/// A bit of a set of flags and the word that tables have for it.
struct FlagWord {
  unsigned bit = 0;
  const char* word = "";
};

/// The words of the bits set, joined by `|`.
std::string joined_flags(unsigned flags, std::span<const FlagWord> words);

/// Words for lighthouse::SweepFlag and track::EpochFlag.
std::string sweep_flag_words(unsigned flags);
std::string epoch_flag_words(unsigned flags);

/// A station's id as printed on it: eight upper-case hexadecimal digits; empty text for none.
std::string station_id_text(const std::optional<std::uint32_t>& id);
/// Two lower-case hexadecimal digits a byte.
std::string hex_text(std::span<const std::uint8_t> bytes);

}  // namespace pharos::tools
