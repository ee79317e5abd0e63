// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::motion {

/// Whether a rotor's flashes come when it can have turned: whole turns after one another. A frame with a good CRC and a
/// wrong time does not.
class RotorGate {
 public:
  /// False for a sweep that fits neither the rotor's last one nor the one refused before it.
  bool fits(const lighthouse::Sweep& sweep) {
    const bool known = last_.fits(sweep), candidate = candidate_.fits(sweep);
    if (known || candidate || !last_.seen) {
      last_.set(sweep);
      candidate_ = {};
      return true;
    }
    candidate_.set(sweep);
    return false;
  }

 private:
  // Flashes depart from whole turns by 40 ticks from one turn to the next (99 % in recordings) and by what the rotor
  // wanders; 300 ticks are what the smoothing takes for a jitter.
  static constexpr std::int64_t kTolerance_ticks = 300, kTolerancePerTurn_ticks = 50;
  // So long without a flash the rotor may be anywhere.
  static constexpr std::int64_t kMaxTurns = 30;

  struct Turn {
    bool seen = false;
    std::int64_t start_ticks = 0;
    std::int64_t period_sixteenth_ticks = 0;

    void set(const lighthouse::Sweep& sweep) {
      seen = true;
      start_ticks = sweep.flash.start_ticks;
      period_sixteenth_ticks = sweep.period_sixteenth_ticks;
    }
    bool fits(const lighthouse::Sweep& sweep) const {
      if (!seen || period_sixteenth_ticks <= 0) return false;
      const std::int64_t since = sweep.flash.start_ticks - start_ticks;
      const std::int64_t turns = (16 * since + period_sixteenth_ticks / 2) / period_sixteenth_ticks;
      if (turns < 1) return false;
      if (turns > kMaxTurns) return true;
      return std::abs(since - turns * period_sixteenth_ticks / 16) < kTolerance_ticks + turns * kTolerancePerTurn_ticks;
    }
  };
  Turn last_, candidate_;
};

/// How often a target's data contradicted a state that was quiet and known: what a body's motion or the light's faults
/// do seldom, and data that are wrong do again and again.
class Contradictions {
 public:
  /// What a violent motion also makes, in two seconds.
  static constexpr int kFew = 3;

  /// One at this time.
  void add(std::int64_t ticks) {
    for (std::size_t i = kSuspect - 1; i > 0; --i) at_ticks_[i] = at_ticks_[i - 1];
    at_ticks_[0] = ticks;
    newest_ticks_ = std::max(newest_ticks_, ticks);
    if (recent(ticks) >= static_cast<int>(kSuspect)) suspect_until_ticks_ = ticks + kHold_ticks;
  }
  /// Of the last two seconds; kSuspect at most.
  int recent(std::int64_t now_ticks) const {
    return static_cast<int>(std::count_if(at_ticks_.begin(), at_ticks_.end(), [now_ticks](std::int64_t at) {
      return at != kNever && std::abs(now_ticks - at) <= kWindow_ticks;
    }));
  }
  /// The target's data are not to be trusted now.
  bool suspect(std::int64_t now_ticks) const {
    return suspect_until_ticks_ != kNever && now_ticks < suspect_until_ticks_ &&
           now_ticks > suspect_until_ticks_ - 2 * kHold_ticks;
  }

 private:
  // In the real recordings, a hand that shakes a controller among them, three come in two seconds at the most
  // (motion_recordings_test); a target with every tenth sweep shifted makes twenty.
  static constexpr std::size_t kSuspect = 5;
  static constexpr std::int64_t kWindow_ticks = 2 * kTicksPerSecond;
  static constexpr std::int64_t kHold_ticks = 4 * kTicksPerSecond;
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

  static constexpr std::array<std::int64_t, kSuspect> never() {
    std::array<std::int64_t, kSuspect> at{};
    for (std::int64_t& one : at) one = kNever;
    return at;
  }
  std::array<std::int64_t, kSuspect> at_ticks_ = never();
  std::int64_t newest_ticks_ = kNever;
  std::int64_t suspect_until_ticks_ = kNever;
};

}  // namespace pharos::motion
