// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_rotor.hpp"

namespace pharos::lighthouse {
namespace {

// Crystals of both ends: within 100 ppm each.
constexpr std::int64_t kMaxRate_q30 = 214'748;  // 200 ppm
// Two beams of one turn lead to one sync within 5 ns each (captures). Light of two stations at once may be read with
// the phase of the other's clock, half a bit off: 0.25 us.
constexpr std::int64_t kSameTurn_sixths = 75;
// A rotor's turn departs from the one before by 0.1 to 0.3 us (captures), from nominal by crystals.
constexpr std::int64_t kTurnJitter_sixths = 600;
// Without a beam for this many turns (1 s) the rotor is lost.
constexpr std::int64_t kMaxTurnsWithout = 50;
// A rotor that was confirmed within this many turns is not given up for two beams that contradict it.
constexpr std::int64_t kMinTurnsWithout = 3;
// Beams that wait longer than this many turns are dropped.
constexpr std::int64_t kMaxTurnsWaiting = 4;
constexpr int kRateSamples = 16;
// Beams this far apart in one turn tell the rate: 1/8 turn, where 5 ns are 2 ppm.
constexpr std::int32_t kMinRateBits = 15'000;

constexpr std::int64_t magnitude(std::int64_t value) { return value < 0 ? -value : value; }

/// Nearest whole number; n may be negative, d is positive.
constexpr std::int64_t rounded(std::int64_t n, std::int64_t d) { return (n < 0 ? n - d / 2 : n + d / 2) / d; }

std::int64_t bits_to_sixths(const Lh2Beam& beam) { return std::int64_t{beam.place} * kBit_sixths; }

std::int64_t scaled(std::int64_t sixths, std::int64_t rate_q30) { return (sixths * rate_q30) >> 30; }

}  // namespace

std::int64_t Lh2Rotor::sync_of(const Lh2Beam& beam) const {
  const std::int64_t since = bits_to_sixths(beam);
  return beam.time_sixths - since - scaled(since, rate_q30_);
}

bool Lh2Rotor::agree(const Lh2Beam& a, const Lh2Beam& b) const {
  const std::int64_t turn = lh2_turn_sixths(a.channel);
  const std::int64_t apart = sync_of(b) - sync_of(a);
  const std::int64_t turns = rounded(apart, turn);
  if (turns < 0 || turns > kMaxTurnsWaiting) return false;
  const std::int64_t span = turns * turn + magnitude(bits_to_sixths(b) - bits_to_sixths(a));
  const std::int64_t tolerance = kSameTurn_sixths + turns * kTurnJitter_sixths + scaled(span, kMaxRate_q30);
  // The same light twice (a place repeats only after a sequence) proves nothing.
  const bool same = a.sensor == b.sensor && magnitude(b.time_sixths - a.time_sixths) < lh2_turn_sixths(a.channel) / 64;
  return !same && magnitude(apart - turns * turn) <= tolerance;
}

std::optional<Lh2Placed> Lh2Rotor::place(const Lh2Beam& beam) const {
  const std::int64_t sync = sync_of(beam);
  const std::int64_t turns = rounded(sync - last_.sync_sixths, turn_sixths_);
  if (turns < -1 || turns > kMaxTurnsWithout) return std::nullopt;
  const std::int64_t apart = magnitude(sync - last_.sync_sixths - turns * turn_sixths_);
  // Until the rate is known its error counts as well.
  const std::int64_t by_rate =
      rate_samples_ >= 4 ? 0 : scaled(bits_to_sixths(beam) + magnitude(turns) * turn_sixths_, kMaxRate_q30);
  const std::int64_t between = kTurnJitter_sixths * magnitude(turns);
  if (apart > kSameTurn_sixths + between + by_rate) return std::nullopt;
  return Lh2Placed{last_.turn + turns, sync};
}

void Lh2Rotor::learn_rate(const Lh2Beam& beam) {
  const std::int64_t bits = std::int64_t{beam.place} - std::int64_t{reference_.place};
  if (magnitude(bits) < kMinRateBits) return;
  const std::int64_t passed = beam.time_sixths - reference_.time_sixths;
  const std::int64_t nominal = bits * kBit_sixths;
  const std::int64_t rate = ((passed - nominal) * (std::int64_t{1} << 30)) / nominal;
  if (magnitude(rate) > kMaxRate_q30) return;
  if (rate_samples_ < kRateSamples) ++rate_samples_;
  rate_q30_ += (rate - rate_q30_) / rate_samples_;
}

void Lh2Rotor::take(const Lh2Beam& beam, const Lh2Placed& placed) {
  if (placed.turn == last_.turn) return learn_rate(beam);
  if (placed.turn < last_.turn) return;
  const std::int64_t turns = placed.turn - last_.turn;
  const std::int64_t turn = rounded(placed.sync_sixths - last_.sync_sixths, turns);
  turn_sixths_ += rounded(turn - turn_sixths_, 4);
  last_ = placed;
  reference_ = beam;
}

void Lh2Rotor::find(const Lh2Beam& beam, Outcome& outcome) {
  const std::int64_t oldest = beam.time_sixths - kMaxTurnsWaiting * lh2_turn_sixths(beam.channel);
  for (std::size_t i = 0; i < waiting_.size();) {
    if (agree(waiting_[i], beam)) {
      const std::int64_t turn = last_.turn + 1;  // numbers only grow
      reference_ = waiting_[i];
      turn_sixths_ = lh2_turn_sixths(beam.channel);
      rate_samples_ = 0;
      rate_q30_ = 0;
      last_ = {turn, sync_of(reference_)};
      outcome.confirmed = reference_;
      outcome.confirmed_at = last_;
      outcome.found = true;
      running_ = true;
      outcome.dropped += static_cast<std::uint32_t>(waiting_.size() - 1);
      waiting_.clear();
      outcome.placed = place(beam);
      if (outcome.placed) {
        take(beam, *outcome.placed);
      } else {
        ++outcome.dropped;
      }
      return;
    }
    if (waiting_[i].time_sixths < oldest) {
      waiting_.erase_unordered(i);
      ++outcome.dropped;
    } else {
      ++i;
    }
  }
  if (waiting_.full()) {
    waiting_.erase_unordered(0);
    ++outcome.dropped;
  }
  waiting_.push_back(beam);
}

Lh2Rotor::Outcome Lh2Rotor::push(const Lh2Beam& beam) {
  Outcome outcome;
  if (running_) {
    outcome.placed = place(beam);
    if (outcome.placed) {
      take(beam, *outcome.placed);
      return outcome;
    }
    const std::int64_t without = beam.time_sixths - last_.sync_sixths;
    if (without > kMaxTurnsWithout * turn_sixths_) {
      running_ = false;
      outcome.lost = true;
    } else if (magnitude(without) < kMinTurnsWithout * turn_sixths_) {
      ++outcome.dropped;
      return outcome;
    }
  }
  find(beam, outcome);
  return outcome;
}

std::uint32_t Lh2Rotor::flush() {
  const auto waiting = static_cast<std::uint32_t>(waiting_.size());
  waiting_.clear();
  return waiting;
}

}  // namespace pharos::lighthouse
