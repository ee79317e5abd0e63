// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/lh2_channels.hpp"

namespace pharos::lighthouse {

// A window is 17 consecutive bits of a sequence, the first in bit 16. The window 1 has place 0: the sync.

inline constexpr std::uint32_t kWindowMask = 0x1FFFF;
inline constexpr std::size_t kWindowBits = 17;

constexpr std::uint32_t parity(std::uint32_t word) {
  word ^= word >> 16U;
  word ^= word >> 8U;
  word ^= word >> 4U;
  return 0x6996U >> (word & 0xFU) & 1U;
}

/// The bit after `window` in a sequence of these taps.
constexpr std::uint32_t bit_after(std::uint32_t window, std::uint32_t taps) { return parity(window & taps); }
/// The window one bit later.
constexpr std::uint32_t window_after(std::uint32_t window, std::uint32_t taps) {
  return (window << 1U & kWindowMask) | bit_after(window, taps);
}
/// The window one bit earlier: all taps have bit 16, so the bit that was shifted out follows.
constexpr std::uint32_t window_before(std::uint32_t window, std::uint32_t taps) {
  const std::uint32_t rest = window >> 1U;
  return rest | ((window & 1U) ^ parity(rest & taps)) << 16U;
}

/// Places of windows in the 32 sequences: the discrete logarithm in GF(2^17), by distinguished points.
///
/// In the other form of the same register (Galois: one shift and one exclusive or) states with ten low zeros are
/// marked, 127 of each sequence, indexed by their high bits. A search steps from the window's state to the next marked
/// one: some 2000 steps on average, as marked states come in groups. Fixed memory, 16 KiB; construction steps once
/// through all sequences (4.2 M steps).
class Lh2Sequences {
 public:
  Lh2Sequences();

  /// Place of `window` (1..0x1FFFF) in a sequence (2 x channel + slow bit), 0..131070; empty for window 0.
  std::optional<std::uint32_t> place_of(std::uint32_t window, std::size_t sequence) const;

 private:
  static constexpr unsigned kMarkBits = 10;
  std::array<std::array<std::uint32_t, (kWindowMask >> kMarkBits) + 1>, kLh2Sequences> marked_;
};

}  // namespace pharos::lighthouse
