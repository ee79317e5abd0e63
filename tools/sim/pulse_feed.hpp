// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"

namespace pharos::sim {

/// Relation between a target's counter and the time since its recording or scenario began.
struct PlayClock {
  std::function<double(std::int64_t)> seconds_at;  // of a stamp
  std::function<std::int64_t(double)> ticks_at;    // of a time since the start, s
};

/// Gives a recording's pulses with the moments at which they are to be played.
///
/// A pulse is due at its end. Stamps of their own kind (stale or future by seconds, as devices send at the start) are
/// told by their 32 followers: when fewer than half lie within 2 s of a stamp, it is given out at once and moves
/// nothing. A long dark gap is therefore waited for, a stale pulse is not.
class PulseFeed {
 public:
  using Source = std::function<std::optional<lighthouse::RawPulse>()>;

  explicit PulseFeed(Source source);

  struct Due {
    lighthouse::RawPulse pulse;
    std::int64_t due_ticks = 0;  // never runs backwards
  };
  /// Next pulse; empty at the end.
  const Due* peek();
  void pop();
  /// When the first pulse that can be trusted ends.
  std::optional<std::int64_t> first_ticks();

 private:
  void fill();
  bool has_simultaneous(std::size_t index) const;

  Source source_;
  std::deque<lighthouse::RawPulse> ahead_;
  std::optional<Due> next_;
  std::optional<std::int64_t> now_ticks_;
};

}  // namespace pharos::sim
