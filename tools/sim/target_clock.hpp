// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace pharos::sim {

/// The simulated target's 50 MHz counter: count = start + 50e6 ((1 + offset) t + drift t^2 / 2), t the true time since
/// the scenario's start.
class TargetClock {
 public:
  TargetClock(std::int64_t start_ticks, double offset_ppm, double drift_ppm_per_s)
      : start_ticks_(start_ticks), rate_(1.0 + offset_ppm * 1e-6), drift_per_s_(drift_ppm_per_s * 1e-6) {}

  /// Ticks since the start at true time `time_s`, not rounded.
  double elapsed_ticks(double time_s) const {
    return kTicksPerTrueSecond * (rate_ + 0.5 * drift_per_s_ * time_s) * time_s;
  }
  /// The counter at true time `time_s`, without wrap.
  std::int64_t stamp(double time_s) const { return start_ticks_ + std::llround(elapsed_ticks(time_s)); }
  /// Counter time in seconds (unwrapped ticks x 20 ns) at true time `time_s`.
  double counter_time(double time_s) const {
    return (static_cast<double>(start_ticks_) + elapsed_ticks(time_s)) / kTicksPerTrueSecond;
  }
  /// True time at which the counter time is `counter_s`; inverse of counter_time.
  double true_time(double counter_s) const {
    const double elapsed_s = counter_s - static_cast<double>(start_ticks_) / kTicksPerTrueSecond;
    double time_s = elapsed_s / rate_;
    for (int step = 0; step < 3; ++step) {
      time_s += (elapsed_s - elapsed_ticks(time_s) / kTicksPerTrueSecond) / (rate_ + drift_per_s_ * time_s);
    }
    return time_s;
  }
  std::int64_t start_ticks() const { return start_ticks_; }

  static constexpr double kTicksPerTrueSecond = 50e6;

 private:
  std::int64_t start_ticks_;
  double rate_;
  double drift_per_s_;
};

}  // namespace pharos::sim
