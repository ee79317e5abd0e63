// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/ring.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/slot_tracker.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// Gathers the hits behind each flash to a sweep, and holds finished sweeps until they are taken.
///
/// A sweep is finished when time has passed its window or its station flashed again; sweeps come out in the order of
/// their flashes. Every flash gives a sweep, also one without hits and that of a slot whose laser is dark (skip):
/// whoever smooths flashes needs them all, without the dark ones the rotor is seen every other turn only.
class SweepCollector {
 public:
  /// Finished sweeps held for a caller that takes them after each push; more are dropped and counted.
  static constexpr std::size_t kHeld = 4;

  void push(const TrackedFlash& flash, DecoderCounters& counters);
  void push(const Pulse& hit, DecoderCounters& counters);
  /// No pulse before `now_ticks` will come any more.
  void pass_time(std::int64_t now_ticks, DecoderCounters& counters);
  void finish_all(DecoderCounters& counters);

  /// Earliest time at which pass_time() has something to do.
  std::int64_t deadline_ticks() const { return deadline_; }
  bool has_finished() const { return !finished_.empty(); }
  Sweep take() { return finished_.pop(); }

 private:
  struct Open {
    Sweep sweep;  // after it is finished: of the station's last flash
    bool open = false;
    bool ever = false;
  };
  /// Finishes what began at `start_ticks` or earlier, first flash first.
  void finish_until(std::int64_t start_ticks, DecoderCounters& counters);
  void finish(Open& open, DecoderCounters& counters);

  std::array<Open, kMaxStations> open_;  // by station number
  std::int64_t deadline_ = INT64_MAX;
  Ring<Sweep, kHeld> finished_;
};

}  // namespace pharos::lighthouse
