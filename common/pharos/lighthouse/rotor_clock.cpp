// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/rotor_clock.hpp"

#include <algorithm>

namespace pharos::lighthouse {
namespace {

/// Rotors are held to 60 Hz within this; a period off by more is rejected (0.1 %). In 1/256 tick.
constexpr std::int32_t kPeriodSlackUnits = 833 * 256;
/// Longest gap over which extrapolate() returns a result.
constexpr std::int64_t kLongestExtrapolation_ticks = 300 * kTicksPerSecond;
/// This many revolutions, and a power of two.
constexpr std::int32_t kLongestExtrapolationDigit = 1 << 14;
static_assert(kLongestExtrapolation_ticks / kTurn_ticks < kLongestExtrapolationDigit * 2 - 40);

}  // namespace

RotorClock::Fit RotorClock::extrapolate(std::int64_t start_ticks) const {
  const std::int64_t elapsed = start_ticks - last_ticks_;
  if (!known() || elapsed < -kLongestExtrapolation_ticks || elapsed > kLongestExtrapolation_ticks) return {};
  // Whole revolutions nearest to it. Digit by digit: a 64-bit division is a kilobyte of code on a 32-bit core.
  const std::uint64_t period = period_;
  std::uint64_t rest = static_cast<std::uint64_t>(elapsed < 0 ? -elapsed : elapsed) * kUnits + period / 2;
  std::int32_t turns = 0;
  for (std::int32_t digit = kLongestExtrapolationDigit; digit != 0; digit /= 2) {
    if (rest < period * static_cast<std::uint32_t>(digit)) continue;
    rest -= period * static_cast<std::uint32_t>(digit);
    turns += digit;
  }
  if (elapsed < 0) turns = -turns;
  const std::int64_t whole = static_cast<std::int64_t>(period) * turns;
  return {turns, static_cast<std::int32_t>(elapsed - (whole + kUnits / 2) / kUnits), true};
}

void RotorClock::update(std::int64_t start_ticks, std::uint32_t slot) {
  const Fit since = fit(start_ticks);
  if (since.turns > 0) {
    // Deviation from nominal: of all revolutions, in 32 bits as in fit(); of one, rounded down.
    const auto ticks = static_cast<std::uint32_t>(start_ticks - last_ticks_);
    const auto off_nominal =
        static_cast<std::int32_t>(ticks * kUnits - static_cast<std::uint32_t>(since.turns) * kNominalPeriod);
    const std::int32_t off_a_turn = (off_nominal - (off_nominal < 0 ? since.turns - 1 : 0)) / since.turns;
    if (off_a_turn < kPeriodSlackUnits && off_a_turn > -kPeriodSlackUnits) {
      const auto turn = kNominalPeriod + static_cast<std::uint32_t>(off_a_turn);
      const auto weight = static_cast<std::int32_t>(std::min(count_, kAveragedTurns));
      period_ += static_cast<std::uint32_t>(static_cast<std::int32_t>(turn - period_) / weight);
      ++count_;
    }
  } else {
    count_ = 1;
    period_ = kNominalPeriod;
  }
  last_ticks_ = start_ticks;
  last_slot_ = slot;
}

}  // namespace pharos::lighthouse
