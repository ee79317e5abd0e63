// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pharos::host {

// What a TOML file may hold. The parser descends once a level, and so does whoever frees the tree: a key of 50,000
// dotted parts overflows the stack. No file of Pharos goes deeper than three.

/// Arrays and inline tables within one another.
inline constexpr std::size_t kMaxTomlNesting = 16;
/// Parts of a dotted key or of a table's name.
inline constexpr std::size_t kMaxTomlKeyParts = 16;
/// Ten times the largest calibration: 32 sensors and two stations, and the covariance of all that.
inline constexpr std::size_t kMaxTomlBytes = 4u << 20;

/// What goes beyond these limits, and in which line (1 is the first).
struct TomlExcess {
  std::uint32_t line = 1;
  std::string what;
};

/// The first excess in `text`; empty where there is none. Strings and comments are skipped as the parser skips them.
/// Time linear in the text, no recursion.
std::optional<TomlExcess> toml_excess(std::string_view text);

}  // namespace pharos::host
