// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/sweep_collector.hpp"

#include <algorithm>
#include <bit>

namespace pharos::lighthouse {
namespace {

/// Wide hits are held back with what may be a flash, at most this long.
constexpr std::int64_t kSweepDoneTicks =
    std::int64_t{kSweepWindowEndTicks} + kFlashRiseSpreadTicks + 2 * kLongestPulseTicks;
/// Before the next slot's hits can begin, a stray pulse is not for want of a flash.
constexpr std::uint64_t kNextWindowTicks = kSlotTicks + kSweepWindowBeginTicks;

}  // namespace

void SweepCollector::push(const TrackedFlash& flash, DecoderCounters& counters) {
  Open& open = open_[flash.flash.station];
  if (open.open) finish_until(open.flash.start_ticks, counters);
  open.flash = flash.flash;
  open.place = static_cast<std::uint8_t>(std::countr_zero(free_));
  open.open = true;
  open.ever = true;
  free_ &= free_ - 1U;
  Sweep& sweep = places_[open.place];
  sweep.flash = flash.flash;
  sweep.period_sixteenth_ticks = flash.period_sixteenth_ticks;
  sweep.flags = flash.flags;
  sweep.hits.clear();
  deadline_ = std::min(deadline_, flash.flash.start_ticks + kSweepDoneTicks);
}

void SweepCollector::push(const Pulse& hit, DecoderCounters& counters) {
  bool flash_seen = false;
  for (Open& open : open_) {
    if (!open.ever || open.flash.skip) continue;
    const auto after_flash = static_cast<std::uint64_t>(hit.rise_ticks - open.flash.start_ticks);
    if (after_flash >= kNextWindowTicks) continue;  // or before it
    flash_seen = true;
    if (!open.open) continue;
    const std::int32_t centre_half_ticks = 2 * static_cast<std::int32_t>(after_flash) + hit.width_ticks;
    if (centre_half_ticks < 2 * kSweepWindowBeginTicks || centre_half_ticks > 2 * kSweepWindowEndTicks) continue;
    const bool kept = places_[open.place].hits.push_back(
        {hit.sensor, static_cast<std::uint16_t>(hit.width_ticks), centre_half_ticks});
    ++(kept ? counters.hits : counters.hits_overflow);
    return;
  }
  ++(flash_seen ? counters.hits_out_of_window : counters.hits_no_flash);
}

void SweepCollector::pass_time(std::int64_t now_ticks, DecoderCounters& counters) {
  if (now_ticks < deadline_) return;
  finish_until(now_ticks - kSweepDoneTicks, counters);
  deadline_ = INT64_MAX;
  for (const Open& open : open_) {
    if (open.open) deadline_ = std::min(deadline_, open.flash.start_ticks + kSweepDoneTicks);
  }
}

void SweepCollector::finish_all(DecoderCounters& counters) {
  finish_until(INT64_MAX, counters);
  deadline_ = INT64_MAX;
}

void SweepCollector::finish_until(std::int64_t start_ticks, DecoderCounters& counters) {
  Open& first = open_[open_[1].flash.start_ticks < open_[0].flash.start_ticks ? 1 : 0];
  Open& second = &first == &open_[0] ? open_[1] : open_[0];
  for (Open* open : {&first, &second}) {
    if (open->open && open->flash.start_ticks <= start_ticks) finish(*open, counters);
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
  if (open.flash.skip) {
    ++counters.sweeps_dark;
  } else if (places_[open.place].hits.empty()) {
    ++counters.sweeps_empty;
  }
}

}  // namespace pharos::lighthouse
