// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos {

namespace detail {

inline constexpr std::uint32_t kDeBruijn = 0x077CB531U;
// Not within the function: there each call would copy it to the stack.
inline constexpr auto kPlaceOfDeBruijn = [] {
  std::array<std::uint8_t, 32> places{};
  for (std::uint8_t place = 0; place < 32; ++place) places[(kDeBruijn << place) >> 27U] = place;
  return places;
}();

}  // namespace detail

/// Number of the lowest bit set; `bits` must not be 0.
///
/// By a de Bruijn sequence (Leiserson, Prokop and Randall, "Using de Bruijn Sequences to Index a 1 in a Computer Word",
/// 1998): a core without the instruction calls a library for std::countr_zero, 20 instructions and a third of a
/// kilobyte.
constexpr std::uint8_t lowest_bit(std::uint32_t bits) {
  return detail::kPlaceOfDeBruijn[((bits & (0U - bits)) * detail::kDeBruijn) >> 27U];
}

}  // namespace pharos
