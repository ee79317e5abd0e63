// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/flash_grouping.hpp"
#include "pharos/lighthouse/rotor_clock.hpp"
#include "pharos/lighthouse/slot_search.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

/// A group of pulses that was recognised as a station's flash.
struct TrackedFlash {
  Flash flash;
  std::uint32_t period_sixteenth_ticks = 0;
  std::uint8_t flags = 0;     // of SweepFlag
  bool follows_last = false;  // the same station's flash one slot earlier was seen too: no OOTX bit is missing between
};

/// Quality of the lock on the slot cycle.
struct LockState {
  bool locked = false;
  struct Station {
    bool seen = false;         // at least one flash in the last 16 slots
    std::uint8_t quality = 0;  // flashes recognised in the last 16 slots, 0..16
  };
  std::array<Station, kMaxStations> station;  // by station number
};

/// Finds the slot cycle of one or two stations and identifies every flash: station, axis, skip, data.
///
/// When locked, a flash is expected one revolution (or some) after the rotor's last, and only its data bit is read from
/// its length. A flash that only weak sensors saw is late, and short by what it lost in strength; its start is
/// corrected from length and prediction. Lock is lost when no flash fitted for half a second, or when the last groups
/// fit another cycle more clearly than the present one (a station restarted). A station that is seen again after a loss
/// of signal keeps its number when the phase of its rotors matches.
class SlotTracker {
 public:
  std::optional<TrackedFlash> push(const FlashCandidate& candidate, DecoderCounters& counters);
  bool locked() const { return locked_; }
  LockState lock(std::int64_t now_ticks) const;
  /// Time of the last recognised flash, or INT64_MIN.
  std::int64_t last_flash_ticks() const { return last_flash_ticks_; }

 private:
  struct Station {
    std::array<RotorClock, kAxes> rotor;
    std::uint32_t last_slot = 0;
    std::uint32_t seen = 0;  // bit 0: slot last_slot, bit n: n slots earlier
    bool known = false;      // has flashed under the present lock
    /// Mean length of this station's flashes minus nominal, in 1/64 tick: it depends on distance and receiver.
    std::int32_t excess = 0;
    std::uint32_t excess_count = 0;
  };

  /// Position of a flash according to its time.
  struct Place {
    SlotPlace place;
    std::int32_t late_ticks = 0;  // after the rotor's prediction
    bool predicted = false;       // by its own rotor
    bool found = false;
  };
  /// Its code according to its length.
  struct Reading {
    bool plausible = false;
    bool data = false;
    std::int32_t missing_ticks = 0;  // of the station's usual length
  };

  Place expected_place(std::int64_t start_ticks) const;
  Place place_by_sibling(std::int64_t start_ticks) const;
  bool skips(const SlotPlace& place) const;
  Reading read_length(std::int32_t length, const Place& place) const;
  TrackedFlash accept(const FlashCandidate& candidate, const Place& place, const Reading& reading,
                      DecoderCounters& counters);
  bool supersedes(const SlotPattern& pattern) const;
  std::optional<TrackedFlash> adopt(SlotPattern pattern, DecoderCounters& counters);
  void assign_numbers(SlotPattern& pattern);
  void lose(DecoderCounters& counters);

  bool locked_ = false;
  SlotPattern::Kind kind_ = SlotPattern::Kind::kNeverSkips;
  std::array<Station, kMaxStations> station_;            // by position in the slot
  std::array<std::uint8_t, kMaxStations> number_{0, 1};  // station number of a position
  bool numbers_given_ = false;
  std::int64_t last_flash_ticks_ = INT64_MIN;
  SlotSearch search_;
};

}  // namespace pharos::lighthouse
