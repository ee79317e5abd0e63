// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_sequence.hpp"

namespace pharos::lighthouse {
namespace {

constexpr std::uint32_t kTop = 1U << 16U;

/// Feedback of the Galois form that has the same sequence at its highest bit: the taps in reverse order.
std::uint32_t reversed(std::uint32_t taps) {
  std::uint32_t out = 0;
  for (unsigned i = 0; i < kWindowBits; ++i) out |= (taps >> i & 1U) << (kWindowBits - 1 - i);
  return out;
}

std::uint32_t step(std::uint32_t state, std::uint32_t feedback) {
  return (state << 1U & kWindowMask) ^ ((state & kTop) != 0 ? feedback : 0U);
}

/// The Galois state whose next 17 bits are `window`: bit j of them is the state's bit 16 - j and what the bits before
/// it feed back there.
std::uint32_t galois_state(std::uint32_t window, std::uint32_t feedback) {
  std::uint32_t state = 0, fed_back = 0;
  for (unsigned j = 0; j < kWindowBits; ++j) {
    const std::uint32_t bit = window >> (kWindowBits - 1 - j) & 1U;
    state |= (bit ^ (fed_back >> 16U & 1U)) << (kWindowBits - 1 - j);
    fed_back = (fed_back << 1U & kWindowMask) ^ (bit != 0 ? feedback : 0U);
  }
  return state;
}

}  // namespace

Lh2Sequences::Lh2Sequences() {
  for (std::size_t sequence = 0; sequence < kLh2Sequences; ++sequence) {
    const std::uint32_t feedback = reversed(kLh2Taps[sequence]);
    std::uint32_t state = galois_state(1, feedback);
    marked_[sequence].fill(0);
    for (std::uint32_t place = 0; place < kLh2SequenceLength; ++place) {
      if ((state & ((1U << kMarkBits) - 1U)) == 0) marked_[sequence][state >> kMarkBits] = place;
      state = step(state, feedback);
    }
  }
}

std::optional<std::uint32_t> Lh2Sequences::place_of(std::uint32_t window, std::size_t sequence) const {
  if (window == 0 || window > kWindowMask || sequence >= kLh2Sequences) return std::nullopt;
  const std::uint32_t feedback = reversed(kLh2Taps[sequence]);
  // The state in the highest 17 bits: what is shifted out is the sign.
  constexpr unsigned kUp = 32 - kWindowBits;
  constexpr std::uint32_t kMark = ((1U << kMarkBits) - 1U) << kUp;
  const std::uint32_t feedback_up = feedback << kUp;
  std::uint32_t state = galois_state(window, feedback) << kUp;
  std::uint32_t steps = 0;
  while ((state & kMark) != 0) {
    state = state << 1U ^ (feedback_up & (0U - (state >> 31U)));
    if (++steps > kLh2SequenceLength) return std::nullopt;  // no sequence of full length: not reached with these taps
  }
  const std::uint32_t place = marked_[sequence][state >> (kMarkBits + kUp)];
  return place >= steps ? place - steps : place + kLh2SequenceLength - steps;
}

}  // namespace pharos::lighthouse
