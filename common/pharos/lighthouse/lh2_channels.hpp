// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pharos::lighthouse {

// Lighthouse 2.0: what identifies a station's light. Each channel has a rotor period and two 17-bit sequences; which of
// the two the light carries in a turn is one bit of OOTX. Sources: public listings of libsurvive's author and of
// Crazyflie's decoder board (sequences, channels 0..15, periods in ticks of 48 MHz).

inline constexpr std::size_t kLh2Channels = 16;
inline constexpr std::size_t kLh2Sequences = 2 * kLh2Channels;

/// Feedback taps: bit i set means that the bit i + 1 places back takes part in the next bit's parity.
inline constexpr std::array<std::uint32_t, kLh2Sequences> kLh2Taps = {
    0x1D258, 0x17E04, 0x1FF6B, 0x13F67, 0x1B9EE, 0x198D1, 0x178C7, 0x18A55, 0x15777, 0x1D911, 0x15769,
    0x1991F, 0x12BD0, 0x1CF73, 0x1365D, 0x197F5, 0x194A0, 0x1B279, 0x13A34, 0x1AE41, 0x180D4, 0x17891,
    0x12E64, 0x17C72, 0x19C6D, 0x13F32, 0x1AE14, 0x14E76, 0x13C97, 0x130CB, 0x13750, 0x1CB8D};

/// One turn of a channel's rotor, bits of the sequence (periods are 959,000 to 887,000 ticks of 48 MHz, 8 a bit).
inline constexpr std::array<std::int32_t, kLh2Channels> kLh2Turn_bits = {
    119'875, 119'625, 119'125, 118'625, 118'375, 117'875, 117'625, 117'375,
    117'125, 116'125, 114'875, 113'875, 113'375, 112'625, 111'625, 110'875};

/// Length of a sequence: all states of 17 bits but zero.
inline constexpr std::uint32_t kLh2SequenceLength = 131'071;

// Times of bits: in sixths of a 20 ns tick (300 MHz), in which a bit of 6 Mbit/s has a whole number.
inline constexpr std::int32_t kSixthsPerTick = 6;
inline constexpr std::int32_t kBit_sixths = 50;
inline constexpr std::int32_t kHalfBit_sixths = 25;

constexpr std::int64_t lh2_turn_sixths(std::size_t channel) {
  return std::int64_t{kLh2Turn_bits[channel]} * kBit_sixths;
}

}  // namespace pharos::lighthouse
