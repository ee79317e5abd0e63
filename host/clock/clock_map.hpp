// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "host/clock/lower_envelope.hpp"
#include "host/clock/steered_clock.hpp"

namespace pharos::host {

/// A time of the target in this computer's clocks.
struct MappedTime {
  std::int64_t utc_ns = 0;        // not before that of any earlier time of the target mapped since the last host jump
  std::int64_t monotonic_ns = 0;  // for ages and latencies: no steering, no steps of the host's clock
  std::int64_t sigma_ns = 0;      // stated uncertainty of utc_ns against the host's own UTC
};

struct ClockCounters {
  std::uint64_t pairs = 0;           // taken
  std::uint64_t pairs_ignored = 0;   // fitted neither the mapping nor each other
  std::uint64_t resynchronised = 0;  // the target's counter began anew or jumped
  std::uint64_t host_steps = 0;      // somebody set the host's clock
  std::uint64_t host_jumps = 0;      // of them by more than can be worked off: UTC began anew there
};

/// Maps the target's 20 ns ticks to UTC, from when frames arrived.
///
/// What is known: a frame that speaks of an instant arrives after it, by a latency that is never negative and at times
/// small. The map is the line under all delays (LowerEnvelope) in the host's monotonic clock, plus the difference of
/// UTC to that clock, led smoothly (SteeredClock). What it cannot know is the part of the latency that every frame has:
/// tell it what is certain, the frame's own time on the line. One false pair, whatever it says, bends nothing.
///
/// When somebody sets the host's clock by more than a second, UTC begins anew there, backwards too: `host_jumps` counts
/// it and `last_jump_ns()` says by how much, for a visible reason wherever times go backwards.
class ClockMap {
 public:
  /// A frame arrived: newest instant of the target's clock that it speaks of, both clocks of the host when its last
  /// byte was read, and how much latency is certain. False where the pair contradicts the mapping and was not taken.
  bool add(std::int64_t ticks, std::int64_t arrival_utc_ns, std::int64_t arrival_monotonic_ns,
           std::int64_t certain_latency_ns = 0);
  /// Empty until pairs span 0.2 s, for times more than 5 s from the newest pair, and while the newest pairs contradict
  /// the mapping (the target may have restarted).
  std::optional<MappedTime> map(std::int64_t ticks);
  /// The target said that it restarted: do not wait to find out.
  void restart();

  bool synchronised() const { return synchronised_; }
  /// Rate of the target's clock against the host's, parts per million; positive: the target's runs fast. 0 until known.
  double drift_ppm() const { return -line_.drift_ns_per_s * 1e-3; }
  /// As in MappedTime, for the newest pair; -1 until synchronised.
  std::int64_t sigma_ns() const;
  /// By how much the host's clock was set at the last jump counted, ns; positive: forwards.
  std::int64_t last_jump_ns() const { return last_jump_ns_; }
  const ClockCounters& counters() const { return counters_; }

 private:
  void begin(std::int64_t ticks, std::int64_t monotonic_ns, std::int64_t arrival_monotonic_ns);
  bool fits(std::int64_t ticks, double delay_ns, double time_s);
  bool repeats(double delay_ns, std::int64_t arrival_monotonic_ns);
  void follow_utc(std::int64_t offset_ns);
  std::int64_t monotonic_of(std::int64_t ticks) const;

  LowerEnvelope envelope_;
  SteeredClock utc_;
  LowerEnvelope::Line line_;
  bool started_ = false;
  bool synchronised_ = false;
  std::int64_t first_ticks_ = 0;
  std::int64_t first_monotonic_ns_ = 0;
  std::int64_t first_arrival_ns_ = 0;
  std::int64_t newest_ticks_ = 0;
  double excess_sum_ns_ = 0.0;  // of delays above the line
  double excess_count_ = 0.0;
  // A mapping that may replace the present one: pairs that fit each other and not it.
  double candidate_delay_ns_ = 0.0;
  std::int64_t candidate_since_ns_ = 0;
  int candidate_pairs_ = 0;
  std::optional<double> drop_ns_;  // delay of the last pair, where it lay far under the line
  // UTC minus monotonic.
  bool offset_known_ = false;
  std::int64_t offset_ns_ = 0;
  int offset_outliers_ = 0;
  std::int64_t last_jump_ns_ = 0;
  ClockCounters counters_;
};

/// Time that a frame takes on the line at least.
constexpr std::int64_t line_time_ns(std::size_t bytes, int baud) {
  constexpr std::int64_t kBitsPerByte = 10;  // 8N1
  return baud <= 0 ? 0 : static_cast<std::int64_t>(bytes) * kBitsPerByte * 1'000'000'000 / baud;
}

}  // namespace pharos::host
