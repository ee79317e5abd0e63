// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace pharos {
class bearings_t;
class clock_exchange_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::tools {

using Json = nlohmann::ordered_json;

// The messages with all their fields, names and units as in proto/: what a message does not apply to is 0 there, too.
Json json_of(const pose_t& message);
Json json_of(const pointing_t& message);
Json json_of(const spin_t& message);
Json json_of(const status_t& message);
Json json_of(const bearings_t& message);
Json json_of(const clock_exchange_t& message);
Json json_of(const target_state_t& message);
/// All but the picture's bytes.
Json json_of(const preview_t& message);

/// The counters alone, by name, for plots: {"utime", "daemon": {...}, "sources": {SOURCE: {...}}}.
Json counters_of(const status_t& message);

/// Whether all its numbers are finite: JSON has no others.
bool all_finite(const Json& value);

/// Bytes as text (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

/// One line. Bytes that are not UTF-8 are replaced.
std::string text_of(const Json& value);

}  // namespace pharos::tools
