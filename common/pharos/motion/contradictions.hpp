// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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

/// Whether a target's data are to be trusted: a cumulative sum (Page, "Continuous inspection schemes", 1954) of sweeps
/// that speak against it, less those that agree with their track. Motion and light make such sweeps now and then, data
/// that are wrong make them again and again. The sum counts sweeps, not time: in darkness nothing is learnt.
class Contradictions {
 public:
  /// A sweep that speaks against the target; weight from 0 to 1.
  void add(double weight) {
    sum_ = std::min(sum_ + static_cast<int>(kOne * weight), kMax);
    suspect_ = suspect_ || sum_ >= kSuspect;
    disputed_ = true;
  }
  /// A sweep that agrees.
  void agree() {
    sum_ = std::max(sum_ - 1, kProven);
    suspect_ = suspect_ && sum_ > kCleared;
    disputed_ = disputed_ && sum_ > kQuiet;
  }
  /// The target's data are not to be trusted now.
  bool suspect() const { return suspect_; }
  /// Sweeps spoke against it again and again, not long ago.
  bool disputed() const { return disputed_; }
  /// Sweeps in a row that nothing must have spoken against before a state is reported.
  int needed() const {
    if (sum_ > kCleared) return 16;
    if (sum_ > kYoung) return 4;
    return sum_ > kShaken ? 2 : 0;
  }

 private:
  // One sweep that no body can have made outweighs fifty that agree: a target with every tenth sweep wrong is suspect
  // after some thirty sweeps, or ninety where it was sound for long. The real recordings, a shaking hand among them,
  // stay below zero (motion_recordings_test).
  static constexpr int kOne = 50, kSuspect = 100, kMax = 250, kCleared = 0;
  // A target begins at zero; a hundred sweeps that agree are the most that count for it.
  static constexpr int kProven = -100, kYoung = -10, kQuiet = -50, kShaken = -60;
  int sum_ = 0;
  bool suspect_ = false, disputed_ = false;
};

}  // namespace pharos::motion
