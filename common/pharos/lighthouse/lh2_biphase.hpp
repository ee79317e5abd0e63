// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/lh2_burst.hpp"

namespace pharos::lighthouse {

inline constexpr std::size_t kMaxBurstBits = 128;

/// Bits of a burst: what a block in logic delivers in place of edges.
struct Lh2Bits {
  std::int64_t start_sixths = 0;  // when the first bit begins, 1/6 tick (1/300 MHz)
  std::uint8_t sensor = 0;
  std::uint8_t count = 0;
  std::array<std::uint32_t, kMaxBurstBits / 32> values{};
  std::array<std::uint32_t, kMaxBurstBits / 32> clean{};  // bits whose both boundaries were seen
  // The light's envelope, 1/6 tick; equal where the receiver showed none.
  std::int64_t light_begin_sixths = 0;
  std::int64_t light_end_sixths = 0;

  bool value(std::size_t bit) const { return (values[bit / 32] >> (bit % 32) & 1U) != 0; }
  bool is_clean(std::size_t bit) const { return (clean[bit / 32] >> (bit % 32) & 1U) != 0; }
};

/// Biphase mark code at 6 Mbit/s: the level changes at each bit's beginning, and in the middle of a one.
///
/// The clock's rate is known (stations' crystals are within 100 ppm), so only its phase is found: the one at which most
/// changes lie on the raster of half bits. Of the two ways to pair halves the one whose boundaries changed more often
/// is taken. A change that is off the raster or missing costs the bits it belongs to (not clean), no others. Empty
/// where the changes show no phase or fewer than 17 bits.
std::optional<Lh2Bits> biphase_bits(const Lh2Burst& burst);

}  // namespace pharos::lighthouse
