// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/runtime/clock.hpp"
#include "host/runtime/replay_speed.hpp"

namespace pharos::host {

/// When recordings that were made together are played, so that all sources keep step: what was recorded at the same
/// instant (monotonic clock of the recording computer) is played at the same instant.
///
/// As a Clock: the recording computer's clocks at what is played. Ages of frames are then those of the recording plus
/// the time that the work takes now.
class ReplayTimeline final : public Clock {
 public:
  /// One recording.
  using Player = std::size_t;

  /// Where nothing at all was recorded for longer than this, the silence is cut to it.
  static constexpr std::int64_t kLongestSilence_ns = 10'000'000'000;
  /// At full speed: time until a recording whose turn it is not asks again.
  static constexpr std::int64_t kNotYourTurn_ns = 200'000;

  /// `clock` must outlive this.
  ReplayTimeline(const Clock& clock, ReplaySpeed speed) : clock_(clock), speed_(speed) {}

  /// All recordings are added before the first one asks. `next_ns`: recorded time of what it plays first.
  Player add(std::int64_t next_ns);
  void set_next(Player player, std::int64_t next_ns) { next_ns_[player] = next_ns; }
  void end(Player player) { next_ns_[player].reset(); }
  /// At full speed nothing is played between these two: work on what was played is not done.
  void hold() { ++held_; }
  void go_on() { --held_; }
  /// Time until the player's next piece is due; 0: now. At full speed pieces are due in the order of their times.
  std::int64_t wait_ns(Player player);
  /// A piece that arrived at these times is played.
  void played(std::int64_t monotonic_ns, std::int64_t utc_ns);

  std::int64_t utc_ns() const override { return monotonic_ns() + utc_minus_monotonic_ns_; }
  std::int64_t monotonic_ns() const override;
  std::int64_t silences_cut() const { return silences_cut_; }

 private:
  std::int64_t earliest_ns() const;

  const Clock& clock_;
  ReplaySpeed speed_;
  std::vector<std::optional<std::int64_t>> next_ns_;  // of each player that has not ended
  std::optional<std::int64_t> shift_ns_;              // this computer's monotonic time minus the recorded one
  std::int64_t played_ns_ = 0;
  std::int64_t utc_minus_monotonic_ns_ = 0;
  std::int64_t silences_cut_ = 0;
  int held_ = 0;
};

}  // namespace pharos::host
