// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace pharos::host {

/// The shortest text without an exponent that reads back exactly, with a fraction.
inline std::string fixed_number(double value) {
  std::array<char, 1100> text{};  // the smallest double has 1074 decimals
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const std::string out(text.data(), result.ptr);
  return out.find_first_of(".n") == std::string::npos ? out + ".0" : out;
}

}  // namespace pharos::host
