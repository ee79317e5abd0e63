// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/sweep_collector.hpp"

#include <algorithm>

#include "pharos/base/lowest_bit.hpp"

namespace pharos::lighthouse {
namespace {

/// Wide hits that may be a flash are held back, at most this long.
constexpr std::int64_t kSweepDone_ticks =
    std::int64_t{kSweepWindowEnd_ticks} + kFlashRiseSpread_ticks + 2 * kLongestPulse_ticks;

}  // namespace

void SweepCollector::push(const TrackedFlash& flash, DecoderCounters& counters) {
  Open& open = open_[flash.flash.station];
  if (open.open) finish_until(open.start_ticks, counters);
  open.start_ticks = flash.flash.start_ticks;
  open.skip = flash.flash.skip;
  open.place = lowest_bit(free_);
  open.open = true;
  open.ever = true;
  free_ &= free_ - 1U;
  Sweep& sweep = places_[open.place];
  // Field by field: copying 17 bytes at once is a call of memcpy on the soft core.
  const Flash& f = flash.flash;
  sweep.flash.start_ticks = f.start_ticks;
  sweep.flash.length_ticks = f.length_ticks;
  sweep.flash.station = f.station;
  sweep.flash.axis = f.axis;
  sweep.flash.data = f.data;
  sweep.flash.skip = f.skip;
  sweep.flash.sensors = f.sensors;
  sweep.period_sixteenth_ticks = flash.period_sixteenth_ticks;
  sweep.flags = flash.flags;
  sweep.hits.clear();
  deadline_ = std::min(deadline_, flash.flash.start_ticks + kSweepDone_ticks);
}

void SweepCollector::pass_time(std::int64_t now_ticks, DecoderCounters& counters) {
  if (now_ticks < deadline_) return;
  finish_until(now_ticks - kSweepDone_ticks, counters);
  deadline_ = INT64_MAX;
  for (const Open& open : open_) {
    if (open.open) deadline_ = std::min(deadline_, open.start_ticks + kSweepDone_ticks);
  }
}

void SweepCollector::finish_all(DecoderCounters& counters) {
  finish_until(INT64_MAX, counters);
  deadline_ = INT64_MAX;
}

void SweepCollector::finish_until(std::int64_t start_ticks, DecoderCounters& counters) {
  Open& first = open_[open_[1].start_ticks < open_[0].start_ticks ? 1 : 0];
  Open& second = &first == &open_[0] ? open_[1] : open_[0];
  for (Open* open : {&first, &second}) {
    if (open->open && open->start_ticks <= start_ticks) finish(*open, counters);
  }
}

void SweepCollector::finish(Open& open, DecoderCounters& counters) {
  open.open = false;
  if (!finished_.push(open.place)) {
    ++counters.outputs_overflow;
    free_ |= 1U << open.place;
    return;
  }
  ++counters.sweeps;
  if (open.skip) {
    ++counters.sweeps_dark;
  } else if (places_[open.place].hits.empty()) {
    ++counters.sweeps_empty;
  }
}

}  // namespace pharos::lighthouse
