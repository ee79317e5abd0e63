// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/light_event.hpp"
#include "pharos/lighthouse/optical_timing.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::lighthouse {

/// Pairs the edges of each sensor, which come in order of time, to pulses.
///
/// Two rises: the fall between them was lost, the newer one counts (one edge dropped). Two falls: the rise was lost,
/// the second is dropped. A fall later than the longest credible pulse: both are dropped, the pulse never ended.
class EdgePairing {
 public:
  std::optional<Pulse> push(const LightEvent& edge, DecoderCounters& counters) {
    const std::uint32_t bit = std::uint32_t{1} << edge.sensor;
    const bool high = (high_ & bit) != 0;
    std::int64_t& rise = rise_ticks_[edge.sensor];
    if (edge.kind == LightEvent::Kind::kRise) {
      if (high) count_missing_fall(edge.stamp_ticks - rise, counters);
      high_ |= bit;
      rise = edge.stamp_ticks;
      return std::nullopt;
    }
    if (!high) {
      ++counters.edges_doubled;
      return std::nullopt;
    }
    high_ ^= bit;
    const auto width = static_cast<std::uint64_t>(edge.stamp_ticks - rise);
    if (width > kLongestPulseTicks) {  // or negative
      counters.edges_never_ended += 2;
      return std::nullopt;
    }
    ++counters.pulses_in;
    return Pulse{rise, static_cast<std::int32_t>(width), edge.sensor};
  }
  /// End of the input: edges that still wait for their partner never ended.
  void end(DecoderCounters& counters);

 private:
  static void count_missing_fall(std::int64_t apart, DecoderCounters& counters);

  std::uint32_t high_ = 0;  // bit per sensor
  std::array<std::int64_t, kMaxSensors> rise_ticks_{};
};

}  // namespace pharos::lighthouse
