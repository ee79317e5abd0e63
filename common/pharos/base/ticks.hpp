// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos {

// Time on the target is counted by a 50 MHz counter: one tick is 20 ns. The hardware counter has 32 bits and wraps
// every 85.9 s; everything after the unwrapper uses 64 bits.
inline constexpr std::int64_t kTicksPerSecond = 50'000'000;
inline constexpr std::int64_t kNanosecondsPerTick = 20;
inline constexpr double kSecondsPerTick = 1.0 / 50e6;

/// Later minus earlier of two readings of a 32-bit counter, right as long as they are less than 42.9 s apart.
constexpr std::int32_t ticks_difference(std::uint32_t later, std::uint32_t earlier) {
  return static_cast<std::int32_t>(later - earlier);
}

constexpr double ticks_to_seconds(std::int64_t ticks) { return static_cast<double>(ticks) * kSecondsPerTick; }
constexpr std::int64_t ticks_to_nanoseconds(std::int64_t ticks) { return ticks * kNanosecondsPerTick; }
constexpr std::int64_t microseconds_to_ticks(std::int64_t microseconds) { return microseconds * 50; }

/// Extends readings of the 32-bit counter to 64 bits by the nearest step from the previous reading.
///
/// A single wrong reading does no lasting harm: the wrapped steps telescope, so a stale or future value is followed by
/// the opposite step back, whatever the size of either.
class TickUnwrapper {
 public:
  constexpr std::int64_t unwrap(std::uint32_t reading) {
    if (!started_) {
      started_ = true;
      unwrapped_ = reading;
    } else {
      unwrapped_ += ticks_difference(reading, static_cast<std::uint32_t>(unwrapped_));
    }
    return unwrapped_;
  }

 private:
  std::int64_t unwrapped_ = 0;
  bool started_ = false;
};

}  // namespace pharos
