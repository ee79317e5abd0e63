// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace pharos::tools {

/// Words for lighthouse::SweepFlag and track::EpochFlag.
std::string sweep_flag_words(unsigned flags);
std::string epoch_flag_words(unsigned flags);

/// A station's id as printed on it: eight upper-case hexadecimal digits; empty text for none.
std::string station_id_text(const std::optional<std::uint32_t>& id);
/// Two lower-case hexadecimal digits a byte.
std::string hex_text(std::span<const std::uint8_t> bytes);

}  // namespace pharos::tools
