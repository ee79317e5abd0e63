// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "host/clock/lower_envelope.hpp"
#include "host/clock/steered_clock.hpp"

namespace pharos::host {

/// A time of the target's counter in this computer's clocks.
struct MappedTime {
  std::int64_t utc_ns = 0;        // not before that of any earlier time of the target mapped since the last host jump
  std::int64_t monotonic_ns = 0;  // for ages and latencies: unaffected by steering and by steps of the host's clock
  std::int64_t sigma_ns = 0;      // stated uncertainty of utc_ns against the host's own UTC
};

struct ClockCounters {
  std::uint64_t pairs = 0;           // taken
  std::uint64_t pairs_ignored = 0;   // agreed neither with the mapping nor with each other
  std::uint64_t resynchronised = 0;  // the target's counter restarted or jumped
  std::uint64_t host_steps = 0;      // the host's clock was set
  std::uint64_t host_jumps = 0;      // of them too large to be slewed: UTC was set anew there
};

/// Maps the target's 20 ns ticks to UTC, from the arrival times of frames.
///
/// A frame that contains an instant arrives after it, by a latency that is never negative and sometimes small. The map
/// is the line under all delays (LowerEnvelope) in the host's monotonic clock, plus the difference of UTC to that
/// clock, slewed smoothly (SteeredClock). The part of the latency that every frame has is not observable: the caller
/// passes the part that is certain, the frame's transmission time. One false pair has no effect on the mapping.
///
/// When the host's clock is set by more than a second, UTC is set anew there, backwards too: `host_jumps` counts it and
/// `last_jump_ns()` returns by how much, so that a caller can report why times went backwards.
class ClockMap {
 public:
  /// A frame arrived: the newest time of the target's clock in it, both clocks of the host when its last byte was read,
  /// and the part of the latency that is certain. False where the pair contradicts the mapping and was not used.
  bool add(std::int64_t ticks, std::int64_t arrival_utc_ns, std::int64_t arrival_monotonic_ns,
           std::int64_t certain_latency_ns = 0);
  /// Empty until pairs span 0.2 s, for times more than 5 s from the newest pair, and while the newest pairs contradict
  /// the mapping (the target may have restarted).
  std::optional<MappedTime> map(std::int64_t ticks);
  /// The target reported a restart: forgets the mapping at once.
  void restart();

  bool synchronised() const { return synchronised_; }
  /// Rate of the target's clock against the host's, parts per million; positive: the target's clock is faster. 0 until
  /// known.
  double drift_ppm() const { return -line_.drift_ns_per_s * 1e-3; }
  /// As in MappedTime, for the newest pair; -1 until synchronised.
  std::int64_t sigma_ns() const;
  /// Change of the host's clock at the last jump counted, ns; positive: forwards.
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
  // A mapping that may replace the present one: pairs that agree with each other and not with it.
  double candidate_delay_ns_ = 0.0;
  std::int64_t candidate_since_ns_ = 0;
  int candidate_pairs_ = 0;
  std::optional<double> drop_ns_;  // delay of the last pair, if it was far under the line
  // UTC minus monotonic.
  bool offset_known_ = false;
  std::int64_t offset_ns_ = 0;
  int offset_outliers_ = 0;
  std::int64_t last_jump_ns_ = 0;
  ClockCounters counters_;
};

/// Minimum transmission time of a frame.
constexpr std::int64_t line_time_ns(std::size_t bytes, int baud) {
  constexpr std::int64_t kBitsPerByte = 10;  // 8N1
  return baud <= 0 ? 0 : static_cast<std::int64_t>(bytes) * kBitsPerByte * 1'000'000'000 / baud;
}

}  // namespace pharos::host
