// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/ring_buffer.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/optical_timing.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/slot_tracker.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Collects the hits behind each flash to a sweep, and holds finished sweeps until they are taken.
///
/// A sweep is finished when time has passed its window or its station flashed again; sweeps are output in the order of
/// their flashes. Every flash gives a sweep, also one without hits and that of a slot whose laser is dark (skip):
/// smoothing needs all of them, else it sees only every other revolution of the rotor.
class SweepCollector {
 public:
  /// Finished sweeps held for a caller that takes them after each push; more are dropped and counted.
  static constexpr std::size_t kHeld = 4;

  void push(const TrackedFlash& flash, DecoderCounters& counters);
  void push(const Pulse& hit, DecoderCounters& counters) {
    bool flash_seen = false;
    for (Open& open : open_) {
      if (!open.ever || open.skip) continue;
      const auto after_flash = static_cast<std::uint64_t>(hit.rise_ticks - open.start_ticks);
      if (after_flash >= kNextWindow_ticks) continue;  // or before it
      flash_seen = true;
      if (!open.open) continue;
      const std::int32_t centre_half_ticks = 2 * static_cast<std::int32_t>(after_flash) + hit.width_ticks;
      if (centre_half_ticks < 2 * kSweepWindowBegin_ticks || centre_half_ticks > 2 * kSweepWindowEnd_ticks) continue;
      const bool kept = places_[open.place].hits.push_back(
          {hit.sensor, static_cast<std::uint16_t>(hit.width_ticks), centre_half_ticks});
      ++(kept ? counters.hits : counters.hits_overflow);
      return;
    }
    ++(flash_seen ? counters.hits_out_of_window : counters.hits_no_flash);
  }
  /// No pulse before `now_ticks` will follow.
  void pass_time(std::int64_t now_ticks, DecoderCounters& counters);
  void finish_all(DecoderCounters& counters);

  /// Earliest time at which pass_time() has something to do.
  std::int64_t deadline_ticks() const { return deadline_; }
  bool has_finished() const { return !finished_.empty(); }
  /// The oldest finished sweep; there must be one. Valid until drop_finished().
  const Sweep& finished() const { return places_[finished_.front()]; }
  void drop_finished() { free_ |= 1U << finished_.pop(); }

 private:
  /// Before the next slot's hits can begin, a stray pulse is not counted as without flash.
  static constexpr std::uint64_t kNextWindow_ticks = kSlot_ticks + kSweepWindowBegin_ticks;

  /// A station's last sweep, open or not.
  struct Open {
    std::int64_t start_ticks = 0;  // of its flash
    std::uint8_t place = 0;        // of the sweep while it is open
    bool open = false;
    bool ever = false;
    bool skip = false;
  };
  /// Finishes what began at `start_ticks` or earlier, first flash first.
  void finish_until(std::int64_t start_ticks, DecoderCounters& counters);
  void finish(Open& open, DecoderCounters& counters);

  std::int64_t deadline_ = INT64_MAX;
  std::array<Open, kMaxStations> open_;  // by station number
  // A sweep is half a kilobyte: it is filled where it stays until it is taken. There is an element for every sweep that
  // is queued or open.
  static constexpr std::size_t kPlaces = kHeld + kMaxStations;
  std::uint32_t free_ = (1U << kPlaces) - 1U;  // bit per place
  RingBuffer<std::uint8_t, kHeld> finished_;   // places, oldest sweep first
  std::array<Sweep, kPlaces> places_;
};

}  // namespace pharos::lighthouse
