// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_slow_bits.hpp"

namespace pharos::lighthouse {

std::optional<OotxFrames::Payload> Lh2SlowBits::push(std::int64_t turn, bool bit, Lh2Counters& counters) {
  if (open_ && turn < turn_) return std::nullopt;
  if (open_ && turn == turn_) {
    contradicted_ = contradicted_ || bit != bit_;
    return std::nullopt;
  }
  std::optional<OotxFrames::Payload> payload;
  if (open_ && contradicted_) ++counters.slow_bits_contradicting;
  if (open_ && !contradicted_) {
    const bool follows_last = turn_ == last_pushed_ + 1;
    if (!follows_last && counters.slow_bits > 0) ++counters.slow_bits_missed;
    payload = frames_.push(bit_, follows_last, frame_counters_);
    ++counters.slow_bits;
    last_pushed_ = turn_;
  }
  open_ = true;
  contradicted_ = false;
  turn_ = turn;
  bit_ = bit;
  return payload;
}

}  // namespace pharos::lighthouse
