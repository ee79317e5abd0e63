// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/rotor_clock.hpp"

#include <algorithm>

namespace pharos::lighthouse {
namespace {

// Measured: 99 % of same-rotor flashes within 40 ticks of the prediction after one turn. Three times that, and 40 more
// for every turn not seen.
constexpr std::int32_t kToleranceTicks = 120;
constexpr std::int32_t kToleranceGrowthTicks = 40;
/// Rotors are held to 60 Hz within this; a turn off by more is no turn (0.1 %).
constexpr std::int64_t kPeriodSlackTicks = 833;
/// Longest gap over which extrapolate() answers.
constexpr std::int64_t kLongestExtrapolationTicks = 300 * kTicksPerSecond;
/// Up to here a turn may be off nominal by all its slack and still be counted right but for one.
constexpr std::int64_t kShortTicks = 64 * std::int64_t{kTurnTicks};

}  // namespace

// Whole turns nearest to a time.
std::int64_t RotorClock::turns_in(std::int64_t elapsed) const {
  const std::int64_t period = period_;
  if (elapsed < 0 || elapsed > kShortTicks) {
    const std::int64_t half = elapsed < 0 ? -period / 2 : period / 2;
    return (elapsed * kUnits + half) / period;
  }
  // The same without a 64-bit division, which a 32-bit core takes hundreds of instructions for: a guess by the nominal
  // turn is off by one at the most.
  std::int64_t turns = static_cast<std::uint32_t>(elapsed) / static_cast<std::uint32_t>(kTurnTicks);
  std::int64_t rest = elapsed * kUnits + period / 2 - turns * period;
  for (; rest < 0; rest += period) --turns;
  for (; rest >= period; rest -= period) ++turns;
  return turns;
}

RotorClock::Fit RotorClock::extrapolate(std::int64_t start_ticks) const {
  const std::int64_t elapsed = start_ticks - last_ticks_;
  if (!known() || elapsed < -kLongestExtrapolationTicks || elapsed > kLongestExtrapolationTicks) return {};
  const std::int64_t turns = turns_in(elapsed);
  const std::int64_t period = period_;
  const std::int64_t residual = elapsed - (turns * period + kUnits / 2) / kUnits;
  return {static_cast<std::int32_t>(turns), static_cast<std::int32_t>(residual), 0, true};
}

RotorClock::Fit RotorClock::fit(std::int64_t start_ticks) const {
  if (start_ticks - last_ticks_ > std::int64_t{kLongestGapTurns + 1} * kTurnTicks) return {};
  Fit fit = extrapolate(start_ticks);
  if (fit.turns < 1 || fit.turns > kLongestGapTurns) return {};
  fit.tolerance_ticks = kToleranceTicks + kToleranceGrowthTicks * fit.turns;
  fit.within = fit.residual_ticks <= fit.tolerance_ticks && fit.residual_ticks >= -fit.tolerance_ticks;
  return fit;
}

void RotorClock::update(std::int64_t start_ticks, std::uint32_t slot) {
  const Fit since = extrapolate(start_ticks);
  if (known() && since.turns > 0 && since.turns <= kLongestGapTurns) {
    const std::int64_t units = (start_ticks - last_ticks_) * kUnits;
    const std::int64_t turn = since.turns == 1 ? units : units / since.turns;
    const std::int64_t off_nominal = turn - kNominalPeriod;
    if (off_nominal < kPeriodSlackTicks * kUnits && off_nominal > -kPeriodSlackTicks * kUnits) {
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
