// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pharos::host {

// Limits of a TOML file. The parser and the destructor of its tree recurse once per level: a key of 50,000 dotted parts
// would overflow the stack. No file of Pharos is nested deeper than three.

/// Maximum nesting of arrays and inline tables.
inline constexpr std::size_t kMaxTomlNesting = 16;
/// Maximum number of parts in a dotted key or a table's name.
inline constexpr std::size_t kMaxTomlKeyParts = 16;
/// Ten times the largest calibration: 32 sensors, two stations and their covariance.
inline constexpr std::size_t kMaxTomlBytes = 4u << 20;

/// An excess of these limits, and its line (1 is the first).
struct TomlExcess {
  std::uint32_t line = 1;
  std::string what;
};

/// The first excess in `text`; empty if there is none. Strings and comments are skipped as the parser skips them.
/// Time linear in the text, no recursion.
std::optional<TomlExcess> toml_excess(std::string_view text);

}  // namespace pharos::host
