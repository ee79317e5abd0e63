// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace pharos {
class bearings_t;
class pointing_t;
class pose_t;
class spin_t;
class status_t;
}  // namespace pharos

namespace pharos::tools {

// The fields of a message on the wire, in order: a number is so many bytes of fixed size, s a text with its length
// before it, [...] a list of such fields with its count before it.
std::string_view layout_of(const pose_t&);
std::string_view layout_of(const pointing_t&);
std::string_view layout_of(const spin_t&);
std::string_view layout_of(const status_t&);
std::string_view layout_of(const bearings_t&);

/// Whether texts and lists of `fields` (a message behind its fingerprint) have lengths that fit, to the last byte.
/// LCM's generated decoders trust them: a negative length throws, a large count takes gigabytes.
bool fits_layout(std::string_view layout, std::span<const std::uint8_t> fields);

}  // namespace pharos::tools
