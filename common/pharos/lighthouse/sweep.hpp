// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/base/flag_word.hpp"
#include "pharos/base/static_vector.hpp"

namespace pharos::lighthouse {

/// One sync flash of a station, recognised.
struct Flash {
  /// Time zero of the slot: rise on the strongest sensor, corrected for lateness where that sensor is weak; 20 ns
  /// ticks, unwrapped, as received (not smoothed).
  std::int64_t start_ticks = 0;
  /// Longest pulse of the flash over all sensors.
  std::int32_t length_ticks = 0;
  std::uint8_t station = 0;  // 0 first flash of the slot or a lone station, 1 second
  Axis axis = Axis::kX;
  bool data = false;         // one OOTX bit
  bool skip = false;         // the station's laser is dark in this slot
  std::uint8_t sensors = 0;  // how many sensors saw it
};

/// Flags of a sweep; one bit each.
enum SweepFlag : std::uint8_t {
  kSweepPeriodNominal = 1,  // no earlier flash of this rotor yet: the nominal period is used
  kSweepFlashWeak = 2,      // only weak sensors saw the flash: its time zero was corrected by an estimate
  kSweepLockPoor = 4,       // the slot sequence has recent gaps
};

inline constexpr std::array<FlagWord, 3> kSweepFlagWords{{
    {kSweepPeriodNominal, "period_nominal"},
    {kSweepFlashWeak, "flash_weak"},
    {kSweepLockPoor, "lock_poor"},
}};

/// One laser hit of one sensor. A sensor may have several in one sweep (reflections): all are kept.
struct Hit {
  std::uint8_t sensor = 0;
  std::uint16_t width_ticks = 0;
  /// Centre of the pulse after the flash's start_ticks, in half ticks (10 ns), exact.
  std::int32_t centre_half_ticks = 0;
};

/// All hits of one rotor's laser in one slot, with the flash that they are measured from. Integers only: the same bits
/// on the target, on the wire and on the host. A slot whose laser is dark (flash.skip) gives a sweep without hits:
/// FlashSmoother needs the flash of every revolution.
struct Sweep {
  Flash flash;
  /// Measured period of this rotor, 1/16 tick.
  std::uint32_t period_sixteenth_ticks = 0;
  std::uint8_t flags = 0;  // of SweepFlag
  StaticVector<Hit, kMaxHitsPerSweep> hits;
};

/// Nominal period of a Lighthouse 1.0 rotor (60 Hz), 20 ns ticks.
inline constexpr double kNominalPeriod_ticks = 50e6 / 60.0;

}  // namespace pharos::lighthouse
