// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/axis.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::lighthouse {

// The timing of Lighthouse 1.0, 20 ns ticks. Public sources count at 48 MHz; their numbers times 50/48 are these.
// "Measured": on 18 real streams of several makers' devices.

/// One revolution of a rotor (60 Hz) and one slot: the rotors of a station sweep alternately.
inline constexpr std::int32_t kTurn_ticks = 833'333;
inline constexpr std::int32_t kSlot_ticks = 416'667;

/// Nominal length of a flash: 62.5 us + 10.417 us * (axis + 2 data + 4 skip). Indexed by that code.
inline constexpr std::array<std::int32_t, 8> kFlashLength_ticks = {3125, 3646, 4167, 4688, 5208, 5729, 6250, 6771};
/// The data bit adds this to the length.
inline constexpr std::int32_t kDataLength_ticks = 1042;

constexpr std::uint32_t flash_code(Axis axis, bool data, bool skip) {
  return static_cast<std::uint32_t>(index_of(axis)) + (data ? 2U : 0U) + (skip ? 4U : 0U);
}

/// Second station's flash after the first's: median 20,390-20,415, extremes 19,716-20,888 (measured).
inline constexpr std::int32_t kSecondFlash_ticks = 20'400;

/// No pulse of a station is longer: 6771 nominal, 6841 measured, and a tenth as margin.
inline constexpr std::int32_t kLongestPulse_ticks = 7500;
/// Shorter ones are glitches: the shortest laser hit measured is 28 ticks, and below 50 they are noise.
inline constexpr std::int32_t kShortestPulse_ticks = 16;
/// Pulses from here on may be a weak sensor's part of a flash; the longest laser hit measured is 1381.
inline constexpr std::int32_t kShortestFlashPulse_ticks = 1500;
/// The longest pulse of a flash is at least this: nominal 3125, measured 2925 where the strongest sensor is weak.
inline constexpr std::int32_t kShortestFlash_ticks = 2600;
/// Pulses of one flash rise within this of one another: the weakest ones were up to 2501 late (measured).
inline constexpr std::int32_t kFlashRiseSpread_ticks = 3000;

/// A hit lies this far behind its flash: measured 1.49-6.25 ms; 1.2-6.6 ms allows a wider field of view.
inline constexpr std::int32_t kSweepWindowBegin_ticks = 60'000;
inline constexpr std::int32_t kSweepWindowEnd_ticks = 330'000;

/// Input may come this much out of order (200 us), counted at rise or at fall.
inline constexpr std::int32_t kReorder_ticks = 10'000;

}  // namespace pharos::lighthouse
