// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {

/// State of one rotor: time of its last flash and its period. Integers only.
///
/// The two rotors of a station are not locked to each other (99 % of flashes lie within 420-450 ticks of half a
/// revolution after the other's), but each is stable (99 % within 40 ticks of one revolution after its last): so each
/// has its own clock.
class RotorClock {
 public:
  /// Revolutions after which the last flash predicts nothing any more (0.5 s).
  static constexpr std::int32_t kLongestGapTurns = 30;

  struct Fit {
    std::int32_t turns = 0;           // since the last flash
    std::int32_t residual_ticks = 0;  // flash minus prediction
    bool within = false;              // the residual is no more than a rotor drifts in so many revolutions
  };

  bool known() const { return count_ > 0; }
  /// At least two flashes: the period is measured.
  bool measured() const { return count_ > 1; }
  void forget() { *this = {}; }
  std::int64_t last_ticks() const { return last_ticks_; }
  std::uint32_t last_slot() const { return last_slot_; }
  std::uint32_t period_sixteenth_ticks() const { return (period_ + 8) / 16; }

  /// Residual of a flash at `start_ticks` against this rotor; never within when it is unknown or without flash for too
  /// long.
  Fit fit(std::int64_t start_ticks) const;
  /// Revolutions and remainder since (or before) the last flash, over any time: to recognise a station after a loss of
  /// signal. Always within, unless the rotor is unknown or the time further off than 300 s.
  Fit extrapolate(std::int64_t start_ticks) const;
  void update(std::int64_t start_ticks, std::uint32_t slot);

 private:
  // Measured: 99 % of same-rotor flashes within 40 ticks of the prediction after one revolution. Three times that, and
  // 40 more for every revolution missed.
  static constexpr std::int32_t kTolerance_ticks = 120;
  static constexpr std::int32_t kToleranceGrowth_ticks = 40;
  // Single periods are noisy by 10 ticks, their mean is far steadier: 16 of them are averaged.
  static constexpr std::uint32_t kAveragedTurns = 16;
  static constexpr int kUnitBits = 8;
  static constexpr std::uint32_t kUnits = 1U << kUnitBits;  // of a tick, in period_
  static constexpr std::uint32_t kNominalPeriod = 213'333'333;

  std::int64_t last_ticks_ = 0;
  std::uint32_t period_ = kNominalPeriod;
  std::uint32_t last_slot_ = 0;
  std::uint32_t count_ = 0;
};

inline RotorClock::Fit RotorClock::fit(std::int64_t start_ticks) const {
  const auto elapsed = static_cast<std::uint64_t>(start_ticks - last_ticks_);
  if (!known() || elapsed > std::uint64_t{kLongestGapTurns + 1} * kTurn_ticks) return {};  // or negative
  const auto ticks = static_cast<std::uint32_t>(elapsed);
  // The nominal period, from which none is off by more than 0.1 %, gives the revolutions to within one. The remainder
  // is so small that 32-bit products may overflow above it.
  std::int32_t turns = static_cast<std::int32_t>((ticks + kTurn_ticks / 2) / kTurn_ticks);
  auto rest = static_cast<std::int32_t>(ticks * kUnits - static_cast<std::uint32_t>(turns) * period_);
  const auto half = static_cast<std::int32_t>(period_ / 2);
  if (rest < -half) {
    --turns;
    rest += static_cast<std::int32_t>(period_);
  } else if (rest >= static_cast<std::int32_t>(period_) - half) {
    ++turns;
    rest -= static_cast<std::int32_t>(period_);
  }
  if (turns < 1 || turns > kLongestGapTurns) return {};
  Fit fit;
  fit.turns = turns;
  fit.residual_ticks = -((static_cast<std::int32_t>(kUnits) / 2 - rest) >> kUnitBits);
  const std::int32_t tolerance = kTolerance_ticks + kToleranceGrowth_ticks * turns;
  fit.within = fit.residual_ticks <= tolerance && fit.residual_ticks >= -tolerance;
  return fit;
}

}  // namespace pharos::lighthouse
