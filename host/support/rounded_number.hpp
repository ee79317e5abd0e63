// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace pharos::host {

/// The number with so many decimals (at most 9), for messages. Up to 1e100; "?" beyond.
inline std::string rounded_number(double value, int decimals) {
  std::array<char, 128> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  return result.ec == std::errc{} ? std::string(text.data(), result.ptr) : "?";
}

}  // namespace pharos::host
