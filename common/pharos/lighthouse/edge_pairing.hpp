// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {

/// Pairs the edges of each sensor, which arrive in order of time, to pulses.
///
/// Two rises: the fall between them was lost, the newer one counts (one edge dropped). Two falls: the rise was lost,
/// the second is dropped. A fall later than the longest plausible pulse: both are dropped.
class EdgePairing {
 public:
  void rise(std::uint8_t sensor, std::int64_t stamp_ticks, DecoderCounters& counters) {
    const std::uint32_t bit = std::uint32_t{1} << sensor;
    if ((high_ & bit) != 0) count_missing_fall(stamp_ticks - rise_ticks_[sensor], counters);
    high_ |= bit;
    rise_ticks_[sensor] = stamp_ticks;
  }
  /// Length of the pulse that ends; negative where none does.
  std::int32_t fall(std::uint8_t sensor, std::int64_t stamp_ticks, DecoderCounters& counters) {
    const std::uint32_t bit = std::uint32_t{1} << sensor;
    if ((high_ & bit) == 0) {
      ++counters.edges_doubled;
      return -1;
    }
    high_ ^= bit;
    const auto width = static_cast<std::uint64_t>(stamp_ticks - rise_ticks_[sensor]);
    if (width > kLongestPulse_ticks) {  // or negative
      counters.edges_never_ended += 2;
      return -1;
    }
    ++counters.pulses_in;
    return static_cast<std::int32_t>(width);
  }
  /// End of the input: edges without a partner are dropped.
  void end(DecoderCounters& counters);

 private:
  static void count_missing_fall(std::int64_t apart, DecoderCounters& counters);

  std::uint32_t high_ = 0;  // bit per sensor
  std::array<std::int64_t, kMaxSensors> rise_ticks_{};
};

}  // namespace pharos::lighthouse
