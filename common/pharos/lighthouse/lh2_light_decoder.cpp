// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_light_decoder.hpp"

namespace pharos::lighthouse {

void Lh2LightDecoder::push(const Lh2Edge& edge) {
  if (const auto burst = collector_.push(edge, sweeps_.counters())) take(*burst);
}

void Lh2LightDecoder::advance(std::int64_t now_ticks) {
  while (const auto burst = collector_.advance(now_ticks, sweeps_.counters())) take(*burst);
  sweeps_.advance(now_ticks * kSixthsPerTick);
}

void Lh2LightDecoder::flush() {
  while (const auto burst = collector_.flush(sweeps_.counters())) take(*burst);
  sweeps_.flush();
}

void Lh2LightDecoder::take(const Lh2Burst& burst) {
  const std::optional<Lh2Bits> bits = biphase_bits(burst);
  if (!bits) {
    ++sweeps_.counters().bursts_no_clock;
    return;
  }
  // Stations that are known first: one that is new costs a search among all 32 sequences.
  std::optional<Lh2Beam> beam = identify(*bits, sweeps_.channels(), sequences_, kSureScore);
  if (!beam) beam = identify(*bits, kAllLh2Channels, sequences_);
  if (!beam) {
    ++sweeps_.counters().bursts_unknown;
    return;
  }
  sweeps_.push(*beam);
}

}  // namespace pharos::lighthouse
