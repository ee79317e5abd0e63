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

class SimulatedTarget;

/// Light that a player gives to a target at its time.
class LightFeed {
 public:
  virtual ~LightFeed() = default;
  /// When the next piece of light is to be given; empty at the end.
  virtual std::optional<std::int64_t> due_ticks() = 0;
  /// Gives that piece.
  virtual void give(SimulatedTarget& target) = 0;
};

/// Gives a recording's pulses with the times at which they are to be played.
///
/// A pulse is due at its end. Outlying stamps (wrong by seconds, as devices send at the start) are detected by the 32
/// following pulses: if fewer than half are within 2 s of a stamp, its pulse is given at once and does not affect the
/// time. The feed therefore waits for a long dark gap, but not for a stale pulse.
class PulseFeed final : public LightFeed {
 public:
  using Source = std::function<std::optional<lighthouse::RawPulse>()>;

  explicit PulseFeed(Source source);

  struct Due {
    lighthouse::RawPulse pulse;
    std::int64_t due_ticks = 0;  // never decreases
  };
  std::optional<std::int64_t> due_ticks() override;
  void give(SimulatedTarget& target) override;

  /// Next pulse; empty at the end.
  const Due* peek();
  void pop();
  /// End of the first pulse that is not an outlier.
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
