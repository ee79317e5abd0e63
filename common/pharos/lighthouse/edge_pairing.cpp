// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/edge_pairing.hpp"

#include <bit>

#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {

std::optional<Pulse> EdgePairing::push(const LightEvent& edge, DecoderCounters& counters) {
  const std::uint32_t bit = std::uint32_t{1} << edge.sensor;
  std::int64_t& rise = rise_ticks_[edge.sensor];
  const bool high = (high_ & bit) != 0;
  if (edge.kind == LightEvent::Kind::kRise) {
    if (high) ++(edge.stamp_ticks - rise > kLongestPulseTicks ? counters.edges_never_ended : counters.edges_doubled);
    high_ |= bit;
    rise = edge.stamp_ticks;
    return std::nullopt;
  }
  if (!high) {
    ++counters.edges_doubled;
    return std::nullopt;
  }
  high_ &= ~bit;
  const std::int64_t width = edge.stamp_ticks - rise;
  if (width > kLongestPulseTicks || width < 0) {
    counters.edges_never_ended += 2;
    return std::nullopt;
  }
  ++counters.pulses_in;
  return Pulse{rise, static_cast<std::int32_t>(width), edge.sensor};
}

void EdgePairing::end(DecoderCounters& counters) {
  counters.edges_never_ended += static_cast<std::uint32_t>(std::popcount(high_));
  high_ = 0;
}

}  // namespace pharos::lighthouse
