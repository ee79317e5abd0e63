// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// Words of track::EpochFlag joined by '|', "" for none: the `flags` of messages.
std::string flag_words(std::uint8_t epoch_flags);
/// Appends a word to such flags.
void add_flag_word(std::string& flags, const char* word);
/// The flag of a measurement whose time may have gone backwards, because this computer's clock was set within the last
/// minute.
inline constexpr const char* kClockSetWord = "clock_set";
/// The word of a target whose data contradict themselves.
inline constexpr const char* kSuspectWord = "suspect";

/// A station's OOTX id as eight hex digits in capitals, as on its label.
std::string station_id_text(std::uint32_t id);

}  // namespace pharos::host
