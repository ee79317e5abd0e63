// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace pharos::host::test {

/// Latency of frames from the target to the host, beyond the certain part.
struct LatencyModel {
  double mean_jitter_ns = 200e3;  // exponential
  std::int64_t usb_poll_ns = 0;   // bytes are delivered at multiples of this
  double stall_fraction = 0.0;    // fraction of frames that are delayed by a busy host
  std::int64_t stall_ns = 0;
};

/// A target's clock and line, and the host's clocks, with known truth. Times in ns; about 116 frames a second, as a
/// target's program sends them after every slot.
class SimulatedLine {
 public:
  SimulatedLine(std::uint64_t seed, double drift_ppm, const LatencyModel& latency)
      : random_(seed), rate_(1.0 + drift_ppm * 1e-6), latency_(latency) {}

  struct Pair {
    std::int64_t ticks = 0;
    std::int64_t arrival_monotonic_ns = 0;
    std::int64_t arrival_utc_ns = 0;
    std::int64_t truth_ns = 0;  // monotonic time of the instant `ticks`
  };

  /// The next frame; its arrival is never before that of the one before.
  Pair next() {
    now_ns_ += 8'333'333 + static_cast<std::int64_t>(random_() % 500'000);
    Pair pair;
    pair.truth_ns = now_ns_;
    pair.ticks = ticks_at(now_ns_);
    std::exponential_distribution<double> jitter(1.0 / latency_.mean_jitter_ns);
    std::int64_t arrival = now_ns_ + static_cast<std::int64_t>(jitter(random_));
    if (std::uniform_real_distribution<double>()(random_) < latency_.stall_fraction) arrival += latency_.stall_ns;
    if (latency_.usb_poll_ns > 0) arrival = (arrival / latency_.usb_poll_ns + 1) * latency_.usb_poll_ns;
    last_arrival_ns_ = std::max(last_arrival_ns_, arrival);
    pair.arrival_monotonic_ns = last_arrival_ns_;
    pair.arrival_utc_ns = last_arrival_ns_ + utc_offset_ns_;
    return pair;
  }
  std::int64_t ticks_at(std::int64_t monotonic_ns) const {
    return counter_start_ + std::llround(static_cast<double>(monotonic_ns - counter_zero_ns_) * rate_ / 20.0);
  }
  void restart_counter(std::int64_t start) {
    counter_start_ = start;
    counter_zero_ns_ = now_ns_;
  }
  void step_utc(std::int64_t by_ns) { utc_offset_ns_ += by_ns; }
  std::int64_t utc_offset_ns() const { return utc_offset_ns_; }
  std::mt19937_64& random() { return random_; }

 private:
  std::mt19937_64 random_;
  double rate_;
  LatencyModel latency_;
  std::int64_t now_ns_ = 5'000'000'000'000;  // the host has been up for 83 minutes
  std::int64_t last_arrival_ns_ = 0;
  std::int64_t counter_start_ = 123'456'789'000;
  std::int64_t counter_zero_ns_ = 5'000'000'000'000;
  std::int64_t utc_offset_ns_ = 1'760'000'000'000'000'000;
};

}  // namespace pharos::host::test
