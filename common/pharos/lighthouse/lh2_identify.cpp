// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_identify.hpp"

#include "pharos/base/ticks.hpp"

namespace pharos::lighthouse {
namespace {

constexpr int kAgrees = 1, kDiffers = -3;
// No other window can be the right one: bits that agree by chance get here once in a thousand bursts.
constexpr int kCertainScore = 24;
constexpr int kGiveUp = 7;  // a stretch ends where the score fell this far below its best

/// How far a sequence agrees on one side of a window.
struct Reach {
  int score = 0;
  std::size_t bits = 0;    // of the stretch, counted from the window
  std::uint8_t agree = 0;  // of them
};

struct Candidate {
  int score = -1;
  std::size_t sequence = 0;
  std::size_t window_at = 0;
  std::uint32_t window = 0;
  std::size_t begin = 0, end = 0;  // the stretch, bits of the burst
  std::uint8_t agree = 0;
};

/// Scores bits one after the other until the stretch is over.
class Scorer {
 public:
  /// False: give up.
  bool add(bool clean, bool agrees) {
    ++bits_;
    if (!clean) return true;
    score_ += agrees ? kAgrees : kDiffers;
    if (agrees) ++agree_;
    if (score_ > best_.score) best_ = {score_, bits_, agree_};
    return score_ > best_.score - kGiveUp;
  }
  const Reach& best() const { return best_; }

 private:
  Reach best_;
  int score_ = 0;
  std::size_t bits_ = 0;
  std::uint8_t agree_ = 0;
};

Reach forward(const Lh2Bits& bits, std::size_t at, std::uint32_t window, std::uint32_t taps) {
  Scorer scorer;
  for (std::size_t i = at; i < bits.count; ++i) {
    window = window_after(window, taps);
    if (!scorer.add(bits.is_clean(i), bits.value(i) == ((window & 1U) != 0))) break;
  }
  return scorer.best();
}

Reach backward(const Lh2Bits& bits, std::size_t at, std::uint32_t window, std::uint32_t taps) {
  Scorer scorer;
  for (std::size_t i = at; i-- > 0;) {
    window = window_before(window, taps);
    if (!scorer.add(bits.is_clean(i), bits.value(i) == ((window >> 16U & 1U) != 0))) break;
  }
  return scorer.best();
}

/// Keeps `best`, or what `sequence` makes of the window at bit `at`.
void try_window(const Lh2Bits& bits, std::size_t at, std::uint32_t window, std::size_t sequence, Candidate& best) {
  const bool inside = sequence == best.sequence && at >= best.begin && at + kWindowBits <= best.end;
  if (inside && best.score >= 0) return;
  const std::uint32_t taps = kLh2Taps[sequence];
  const Reach after = forward(bits, at + kWindowBits, window, taps);
  const Reach before = backward(bits, at, window, taps);
  const int score = after.score + before.score;
  if (score <= best.score) return;
  best = {score,
          sequence,
          at,
          window,
          at - before.bits,
          at + kWindowBits + after.bits,
          static_cast<std::uint8_t>(kWindowBits + after.agree + before.agree)};
}

/// The best of all windows; score -1 where there is none.
Candidate best_of(const Lh2Bits& bits, std::uint32_t channels) {
  Candidate best;
  std::uint32_t window = 0;
  std::size_t clean = 0;  // clean bits in a row
  for (std::size_t i = 0; i < bits.count; ++i) {
    window = (window << 1U | (bits.value(i) ? 1U : 0U)) & kWindowMask;
    clean = bits.is_clean(i) ? clean + 1 : 0;
    if (clean < kWindowBits || window == 0) continue;
    for (std::size_t sequence = 0; sequence < kLh2Sequences; ++sequence) {
      if ((channels >> (sequence / 2) & 1U) == 0) continue;
      try_window(bits, i + 1 - kWindowBits, window, sequence, best);
      if (best.score >= kCertainScore) return best;
    }
  }
  return best;
}

}  // namespace

std::optional<Lh2Beam> identify(const Lh2Bits& bits, std::uint32_t channels, const Lh2Sequences& sequences,
                                int min_score) {
  const Candidate best = best_of(bits, channels);
  if (best.score < 0 || best.score < min_score) return std::nullopt;
  const auto place = sequences.place_of(best.window, best.sequence);
  if (!place) return std::nullopt;
  Lh2Beam beam;
  beam.time_sixths = bits.start_sixths + static_cast<std::int64_t>(best.window_at) * kBit_sixths;
  beam.place = *place;
  beam.sensor = bits.sensor;
  beam.channel = static_cast<std::uint8_t>(best.sequence / 2);
  beam.slow_bit = best.sequence % 2 != 0;
  beam.bits = best.agree;
  // The light's envelope is the best measure of its middle; without one, the bits that agree.
  std::int64_t begin = bits.light_begin_sixths, end = bits.light_end_sixths;
  if (end <= begin) {
    begin = bits.start_sixths + static_cast<std::int64_t>(best.begin) * kBit_sixths;
    end = bits.start_sixths + static_cast<std::int64_t>(best.end) * kBit_sixths;
  }
  beam.centre_sixths = begin + (end - begin) / 2;
  beam.width_ticks = static_cast<std::uint16_t>((end - begin) / kSixthsPerTick);
  return beam;
}

}  // namespace pharos::lighthouse
