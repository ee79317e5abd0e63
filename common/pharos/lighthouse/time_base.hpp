// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/light_event.hpp"
#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::lighthouse {

/// Tracks the current time of a stream whose single stamps may be wrong.
///
/// Stamps up to 25 ms ahead of the newest one, or up to the reorder span behind it, are on the time base. Others are
/// held; when several in a row agree with one another the base moves to them and none of them is lost:
///  - before anything was decoded, or when they lie less than 50 ms behind: four;
///  - in the middle of a recording: four that span 20 ms, or 24 (stale bursts of up to 15 pulses in 4 ms were seen).
/// As soon as a stamp fits the old base again, the held ones are dropped (late or off time).
///
/// Output times never run backwards in a recording. Where the confirmed new time lies before what was already decoded
/// (a 32-bit counter wrapped without light, or the target restarted), the smallest multiple of 2^32 ticks is added that
/// makes it later; a counter that wrapped once without light so gets its true time.
class TimeBase {
 public:
  enum class Verdict : std::uint8_t {
    kFits,        // on the base: pass it on
    kHeld,        // kept back until others agree
    kMoved,       // the base has moved to the held ones, which include this one: pass on held(), then forget_held()
    kOutOfRange,  // beyond the range of any clock: drop
  };
  /// Held events that were dropped.
  struct Discarded {
    std::uint8_t late_pulses = 0, late_edges = 0, off_time_pulses = 0, off_time_edges = 0;
  };
  static constexpr std::size_t kMaxHeld = 24;

  /// Handles most stamps: on the base and nothing held. Puts `event` on unwrapped time.
  bool fits_at_once(LightEvent& event) {
    // As unsigned: no overflow, whatever the stamps.
    const std::uint64_t stamp =
        static_cast<std::uint64_t>(event.stamp_ticks) + (std::uint64_t{offset_counter_spans_} << 32U);
    const std::uint64_t ahead = stamp - static_cast<std::uint64_t>(newest_);
    constexpr auto kBehind = static_cast<std::uint64_t>(kMaxBehind_ticks);
    if (!steady_ || ahead + kBehind > kBehind + static_cast<std::uint64_t>(kMaxAhead_ticks)) return false;
    event.stamp_ticks = static_cast<std::int64_t>(stamp);
    if (static_cast<std::int32_t>(ahead) > 0) newest_ = event.stamp_ticks;
    return true;
  }
  /// All other stamps. `decoded_ticks`: time of the last thing decoded, or kNothingDecoded.
  Verdict classify(LightEvent& event, std::int64_t decoded_ticks, Discarded& discarded);
  /// End of the input: takes what is held if there was no base before, drops it otherwise.
  Verdict end(Discarded& discarded);

  const StaticVector<LightEvent, kMaxHeld>& held() const { return held_; }
  void forget_held() {
    held_.clear();
    steady_ = started_;
  }
  /// The caller's clock has reached this time.
  void advance(std::int64_t now_ticks);

  /// On unwrapped time, like all output.
  std::int64_t newest_ticks() const { return newest_; }
  /// What is added to the caller's stamps: a multiple of 2^32.
  std::int64_t offset_ticks() const { return std::int64_t{offset_counter_spans_} << 32U; }

  static constexpr std::int64_t kNothingDecoded = INT64_MIN;
  static constexpr std::int64_t kMaxAhead_ticks = 1'250'000;  // 25 ms: three slots
  /// Pulses are stamped at their fall: a stream sorted by rise is out of order by up to a pulse's length.
  static constexpr std::int64_t kMaxBehind_ticks = kReorder_ticks + kLongestPulse_ticks;

 private:
  std::int64_t raw_newest() const { return newest_ - offset_ticks(); }
  bool fits(std::int64_t stamp) const;
  bool agrees_with_held(std::int64_t stamp) const;
  bool confirmed(std::int64_t decoded_ticks) const;
  void move_to_held(std::int64_t decoded_ticks);
  void discard_held(Discarded& discarded);

  std::int64_t newest_ = 0;
  std::uint32_t offset_counter_spans_ = 0;  // 2^32 ticks each
  bool started_ = false;
  bool steady_ = false;           // started and nothing held
  std::int64_t held_newest_ = 0;  // as received
  std::int64_t held_oldest_ = 0;
  StaticVector<LightEvent, kMaxHeld> held_;
};

}  // namespace pharos::lighthouse
