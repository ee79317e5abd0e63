// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

namespace pharos::host {

/// A clock that is slewed towards its reference without running backwards: piecewise linear in the target's time,
/// continuous, at half speed at the slowest. Where it is more than a second behind, it jumps forwards.
class SteeredClock {
 public:
  /// The reference reading at `time_ns` of the target, and its rate (1 + drift).
  void steer(std::int64_t time_ns, std::int64_t wanted_ns, double rate);
  /// The clock's reading; empty for times more than kMemory_ns before the newest steering, or after it.
  std::optional<std::int64_t> read(std::int64_t time_ns);
  /// Reference minus reading, ns (positive: the clock is behind), at the last steering.
  std::int64_t remaining_ns() const { return remaining_ns_; }
  /// Whether the reference, changed by `change_ns`, is more than a second away: too far to be slewed.
  bool would_jump(std::int64_t change_ns) const;
  /// Forgets all readings: the next steering sets the clock, backwards too.
  void reset();
  /// The target's counter restarted. The clock continues from its last reading or later.
  void restart();

  static constexpr std::int64_t kMemory_ns = 5'000'000'000;

 private:
  struct Knot {
    std::int64_t time_ns = 0;
    std::int64_t shown_ns = 0;
    double rate = 1.0;
    std::int64_t at(std::int64_t time_ns) const;
  };

  const Knot& knot_for(std::int64_t time_ns) const;

  std::deque<Knot> knots_;  // by time
  std::int64_t remaining_ns_ = 0;
  // The latest reading returned: no later time may have a smaller one.
  std::int64_t latest_read_time_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t latest_shown_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace pharos::host
