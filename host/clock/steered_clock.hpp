// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

namespace pharos::host {

/// A clock that is led towards better knowledge without running backwards: piecewise linear in the target's time,
/// continuous, at half speed at the slowest. Only forwards does it jump of itself, by more than a second at a time.
class SteeredClock {
 public:
  /// What the clock should show at `time_ns` of the target, and the rate (1 + drift) that is known for it.
  void steer(std::int64_t time_ns, std::int64_t wanted_ns, double rate);
  /// What it shows; empty for times more than kMemory_ns before the newest steering, or after it.
  std::optional<std::int64_t> read(std::int64_t time_ns);
  /// How far it is from what it should show, ns (positive: behind), at the last steering.
  std::int64_t remaining_ns() const { return remaining_ns_; }
  /// Whether what it should show, changed by `change_ns`, is more than a second away: too far to be worked off.
  bool would_jump(std::int64_t change_ns) const;
  /// Forgets all that was shown: the next steering sets it, backwards too.
  void reset();
  /// The target's time began anew. What was shown is not taken back: the clock goes on from there at the least.
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
  // The latest reading given out, which no later time may undercut.
  std::int64_t latest_read_time_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t latest_shown_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace pharos::host
