// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"

namespace pharos::lighthouse {

/// Why a payload with a good CRC has no fields.
enum class OotxError : std::uint8_t {
  kNone,
  kUnknownProtocol,  // its low six bits are not 4, 5 or 6
  kTooShort,         // fewer bytes than its protocol has (31; 33 for protocol 6)
  kNotFinite,        // a calibration field is infinite or no number
};

/// The fields of a payload: little-endian, packed; reals are IEEE half precision.
Result<OotxFields, OotxError> ootx_fields(std::span<const std::uint8_t> payload);

/// Value of an IEEE 754 half, exact; needs no hardware support. Infinity and NaN as such.
double half_to_double(std::uint16_t half);

/// Fields of a payload, of either generation: a little-endian word, and a half. `at + 1` must be within.
std::uint16_t ootx_word(std::span<const std::uint8_t> bytes, std::size_t at);
double ootx_half(std::span<const std::uint8_t> bytes, std::size_t at);

}  // namespace pharos::lighthouse
