// SPDX-License-Identifier: Apache-2.0
#include "host/publish/words.hpp"

#include <array>
#include <cstdio>

#include "host/support/flag_text.hpp"
#include "pharos/track/epoch_tracker.hpp"

namespace pharos::host {

std::string flag_words(std::uint8_t epoch_flags) { return joined_flags(epoch_flags, track::kEpochFlagWords); }

void add_flag_word(std::string& flags, const char* word) {
  if (!flags.empty()) flags += '|';
  flags += word;
}

std::string station_id_text(std::uint32_t id) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08X", id);
  return text.data();
}

}  // namespace pharos::host
