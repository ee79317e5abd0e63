// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <string>

namespace pharos::tools {

inline std::string shown(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// For ->check(): a number from `low` to `high`. CLI11's own ranges accept nan (it is neither below nor above a limit)
/// and print their limits with 300 digits.
inline CLI::Validator number_from(double low, double high) {
  const std::string range = "from " + shown(low) + " to " + shown(high);
  return {[low, high, range](std::string& text) {
            double value = 0.0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool number = error == std::errc{} && end == text.data() + text.size();
            return number && value >= low && value <= high ? std::string() : text + " is not a number " + range;
          },
          range, "number"};
}

}  // namespace pharos::tools
