// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace pharos::host {

/// The shortest text that reads back exactly, and with a fraction, because TOML distinguishes integers from floats.
inline std::string exact_number(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  const std::string out(text.data(), result.ptr);
  return out.find_first_of(".e") == std::string::npos ? out + ".0" : out;
}

/// "[a, b, c]" of the same.
template <class Values>
std::string exact_list(const Values& values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : ", ") + exact_number(value);
  return "[" + out + "]";
}

}  // namespace pharos::host
