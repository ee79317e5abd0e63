// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/edge_pairing.hpp"

#include <bit>

namespace pharos::lighthouse {

void EdgePairing::count_missing_fall(std::int64_t apart, DecoderCounters& counters) {
  ++(apart > kLongestPulse_ticks ? counters.edges_never_ended : counters.edges_doubled);
}

void EdgePairing::end(DecoderCounters& counters) {
  counters.edges_never_ended += static_cast<std::uint32_t>(std::popcount(high_));
  high_ = 0;
}

}  // namespace pharos::lighthouse
