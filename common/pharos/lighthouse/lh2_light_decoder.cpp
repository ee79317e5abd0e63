// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_light_decoder.hpp"

namespace pharos::lighthouse {

namespace {

// How often the other sensors' bursts are looked at: 5 us.
constexpr std::int64_t kLook_ticks = 250;

}  // namespace

void Lh2LightDecoder::push(const Lh2Edge& edge) {
  if (is_possible_time(edge.time_ticks)) {
    // Both ways: a time far ahead must not keep it from looking.
    const std::int64_t since = edge.time_ticks - looked_ticks_;
    if (since > kLook_ticks || since < -kLook_ticks) {
      looked_ticks_ = edge.time_ticks;
      while (const auto burst = collector_.advance(edge.time_ticks, sweeps_.counters())) take(*burst);
    }
  }
  if (const auto burst = collector_.push(edge, sweeps_.counters())) take(*burst);
}

void Lh2LightDecoder::advance(std::int64_t now_ticks) {
  if (!is_possible_time(now_ticks)) return;
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
  // Of a station whose sync is known 17 bits at the right place are enough: by chance once in a thousand bursts. One
  // that is new costs a search among all 32 sequences.
  std::optional<Lh2Beam> beam = identify(*bits, sweeps_.channels(), sequences_, 0);
  if (!beam || !sweeps_.fits(*beam)) beam = identify(*bits, kAllLh2Channels, sequences_);
  if (!beam) {
    ++sweeps_.counters().bursts_unknown;
    return;
  }
  sweeps_.push(*beam);
}

}  // namespace pharos::lighthouse
