// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/slot_tracker.hpp"

#include <algorithm>
#include <bit>

namespace pharos::lighthouse {
namespace {

/// Once the position and so axis and skip are known only the data bit is unknown. Lengths vary by 80 around a station's
/// usual one; half of the data bit's step is 521, and at 521 lies the other axis: a length that far off belongs to
/// another cycle.
constexpr std::int32_t kLengthMargin_ticks = 350;
/// A station's usual length is off nominal by -47..+78 (measured).
constexpr std::int32_t kLargestExcess_ticks = 150;
/// Half a revolution after the station's other rotor: 470 ticks cover 99 %; drift over some revolutions is added.
constexpr std::int32_t kOtherRotorTolerance_ticks = 1000;
/// The other station's lag varies by 700 around its median.
constexpr std::int32_t kOtherStationTolerance_ticks = 1700;
/// A pattern must explain this many more groups than the present lock did before it replaces it.
constexpr std::uint32_t kSupersedesBy = 3;
constexpr std::uint32_t kSuspiciousRejections = 5;
/// Two stations' flashes are 20,400 ticks apart: nearer than half of that is the same station.
constexpr std::int32_t kSamePhase_ticks = kSecondFlash_ticks / 2 - 200;
/// Slots of which at least 12 must have been seen for a good lock.
constexpr std::uint32_t kQualitySlots = 16;
constexpr int kGoodQuality = 12;
/// Slot numbers start here so that slots before the first lock stay positive; a multiple of the cycle.
constexpr std::uint32_t kFirstSlot = 1024;

/// A weak sensor sees a flash late by 0.55-0.95 of the length that it loses, up to 670 ticks (measured).
constexpr std::int32_t kLatest_ticks = 750;
constexpr std::int32_t kMinLatenessPercent = 55;
constexpr std::int32_t kMaxLatenessPercent = 95;
/// Flashes are as strong as usual within this; the strongest sensor varies by 45.
constexpr std::int32_t kWeak_ticks = 100;
constexpr std::int32_t kExcessUnits = 64;
constexpr std::uint32_t kExcessFlashes = 64;
constexpr std::int32_t kLargestExcessStep_ticks = 32;

std::uint32_t recent(std::uint32_t seen) { return seen & ((1U << kQualitySlots) - 1U); }

}  // namespace

bool SlotTracker::skips(const SlotPlace& place) const {
  return kind_ != SlotPattern::Kind::kNeverSkips && skip_of_slot(place.slot, place.position);
}

SlotTracker::Place SlotTracker::expected_place(std::int64_t start_ticks) const {
  Place best;
  Place late;
  std::int32_t best_residual = INT32_MAX;
  for (std::uint8_t position = 0; position < kMaxStations; ++position) {
    for (const RotorClock& rotor : station_[position].rotor) {
      const RotorClock::Fit fit = rotor.fit(start_ticks);
      if (fit.turns == 0) continue;
      const SlotPlace place{position, rotor.last_slot() + 2U * static_cast<std::uint32_t>(fit.turns)};
      const std::int32_t residual = fit.residual_ticks < 0 ? -fit.residual_ticks : fit.residual_ticks;
      if (fit.within && residual < best_residual) {
        best_residual = residual;
        best = {place, fit.residual_ticks, true, true};
      } else if (fit.residual_ticks > 0 && fit.residual_ticks <= kLatest_ticks) {
        late = {place, fit.residual_ticks, true, true};
      }
    }
  }
  if (best.found) return best;
  return late.found ? late : place_by_sibling(start_ticks);
}

SlotTracker::Place SlotTracker::place_by_sibling(std::int64_t start_ticks) const {
  constexpr std::int64_t kLongestGap = std::int64_t{RotorClock::kLongestGapTurns} * kTurn_ticks;
  for (std::uint8_t position = 0; position < kMaxStations; ++position) {
    for (std::uint8_t other = 0; other < kMaxStations; ++other) {
      if (other != position && kind_ != SlotPattern::Kind::kBoth) continue;
      const std::int64_t lag = std::int64_t{position - other} * kSecondFlash_ticks;
      const std::int32_t tolerance = other == position ? kOtherRotorTolerance_ticks : kOtherStationTolerance_ticks;
      for (const RotorClock& sibling : station_[other].rotor) {
        const std::int64_t elapsed = start_ticks - sibling.last_ticks() - lag;
        if (!sibling.known() || elapsed < -kSlot_ticks / 2 || elapsed > kLongestGap) continue;
        const auto ticks = static_cast<std::int32_t>(elapsed);
        const std::int32_t slots = (ticks + kSlot_ticks / 2) / kSlot_ticks;
        const std::int32_t residual = ticks - slots * kSlot_ticks;
        if (residual > tolerance || residual < -tolerance) continue;
        const std::uint32_t slot = sibling.last_slot() + static_cast<std::uint32_t>(slots);
        const Station& station = station_[position];
        const RotorClock& own = station.rotor[slot & 1U];
        const bool own_speaks = own.known() && start_ticks - own.last_ticks() <= kLongestGap;
        if (!own_speaks && (!station.known || static_cast<std::int32_t>(slot - station.last_slot) > 0))
          return {{position, slot}, 0, false, true};
      }
    }
  }
  return {};
}

SlotTracker::Reading SlotTracker::read_length(std::int32_t length, const Place& place) const {
  const Station& station = station_[place.place.position];
  const std::int32_t excess = station.excess / kExcessUnits;
  // The lost length of a flash so late, by the middle of the measured range.
  const std::int32_t expected_missing = place.predicted && place.late_ticks > 0 ? place.late_ticks * 4 / 3 : 0;
  Reading best;
  std::int32_t best_error = kLengthMargin_ticks;
  for (const bool data : {false, true}) {
    const std::uint32_t code = flash_code(axis_of_slot(place.place.slot), data, skips(place.place));
    const std::int32_t missing = kFlashLength_ticks[code] + excess - length;
    const std::int32_t error = missing < expected_missing ? expected_missing - missing : missing - expected_missing;
    if (error >= best_error) continue;
    best_error = error;
    best = {true, data, missing};
  }
  return best;
}

TrackedFlash SlotTracker::accept(const FlashCandidate& candidate, const Place& where, const Reading& reading,
                                 DecoderCounters& counters) {
  const SlotPlace& place = where.place;
  Station& station = station_[place.position];
  TrackedFlash tracked;
  Flash& flash = tracked.flash;
  flash.start_ticks = candidate.start_ticks;
  flash.length_ticks = candidate.length_ticks;
  flash.station = number_[place.position];
  flash.axis = axis_of_slot(place.slot);
  flash.skip = skips(place);
  flash.data = reading.data;
  flash.sensors = static_cast<std::uint8_t>(candidate.sensors);
  if (reading.missing_ticks > kWeak_ticks) {
    tracked.flags |= kSweepFlashWeak;
    const std::int32_t minimum = reading.missing_ticks * kMinLatenessPercent / 100;
    const std::int32_t maximum = reading.missing_ticks * kMaxLatenessPercent / 100;
    flash.start_ticks -= where.predicted ? std::clamp(where.late_ticks, minimum, maximum) : (minimum + maximum) / 2;
  }

  const std::uint32_t slots = place.slot - station.last_slot;
  tracked.follows_last = station.known && slots == 1;
  if (station.known && slots > 1) counters.flashes_missed += slots - 1;
  station.seen = (slots < 32 ? station.seen << slots : 0U) | 1U;
  station.last_slot = place.slot;
  station.known = true;
  if (station.excess_count < kExcessFlashes) ++station.excess_count;
  const std::int32_t step = std::clamp(-reading.missing_ticks, -kLargestExcessStep_ticks, kLargestExcessStep_ticks);
  station.excess = std::clamp(station.excess + step * kExcessUnits / static_cast<std::int32_t>(station.excess_count),
                              -kLargestExcess_ticks * kExcessUnits, kLargestExcess_ticks * kExcessUnits);
  last_flash_ticks_ = std::max(last_flash_ticks_, flash.start_ticks);

  RotorClock& rotor = station.rotor[static_cast<std::size_t>(index_of(flash.axis))];
  rotor.update(flash.start_ticks, place.slot);
  tracked.period_sixteenth_ticks = rotor.period_sixteenth_ticks();
  if (!rotor.measured()) tracked.flags |= kSweepPeriodNominal;
  if (std::popcount(recent(station.seen)) < kGoodQuality) tracked.flags |= kSweepLockPoor;
  return tracked;
}

void SlotTracker::assign_numbers(SlotPattern& pattern) {
  // A station known from before the gap is the one whose rotor phase matches.
  std::array<int, kMaxStations> number{-1, -1};
  for (std::size_t age = 0; numbers_given_ && age < search_.size(); ++age) {
    const auto place = search_.place(age, pattern);
    if (!place) continue;
    for (std::size_t before = 0; before < kMaxStations; ++before) {
      const RotorClock& rotor = station_[before].rotor[place->slot & 1U];
      const RotorClock::Fit fit = rotor.extrapolate(search_.candidate(age).start_ticks);
      if (!fit.within || fit.residual_ticks > kSamePhase_ticks || fit.residual_ticks < -kSamePhase_ticks) continue;
      const std::uint32_t slot_then = rotor.last_slot() + 2U * static_cast<std::uint32_t>(fit.turns);
      const bool one_of_two = pattern.kind == SlotPattern::Kind::kOneOfTwo && kind_ != SlotPattern::Kind::kNeverSkips;
      const bool same_skip =
          skip_of_slot(slot_then, static_cast<std::uint8_t>(before)) == skip_of_slot(place->slot, place->position);
      if (one_of_two && !same_skip) continue;
      if (number[place->position] < 0) number[place->position] = number_[before];
      if (one_of_two && before == 1) {
        // The second station alone: number its slots as the second's.
        pattern.newest = {1, pattern.newest.slot + 2U};
        number = {-1, number_[before]};
        age = search_.size();
      }
      break;
    }
  }
  if (number[0] < 0 && number[1] < 0) {
    number = {0, 1};
  } else if (number[0] < 0) {
    number[0] = 1 - number[1];
  } else {
    number[1] = 1 - number[0];
  }
  for (std::size_t position = 0; position < kMaxStations; ++position) {
    number_[position] = static_cast<std::uint8_t>(number[position]);
  }
  numbers_given_ = true;
}

std::optional<TrackedFlash> SlotTracker::adopt(SlotPattern pattern, DecoderCounters& counters) {
  if (locked_) lose(counters);
  assign_numbers(pattern);
  pattern.newest.slot += kFirstSlot;
  kind_ = pattern.kind;
  for (Station& station : station_) station = {};
  std::optional<TrackedFlash> newest;
  const std::uint32_t missed = counters.flashes_missed;  // the groups of the search were counted on arrival
  for (std::size_t age = search_.size(); age-- > 0;) {
    const auto place = search_.place(age, pattern);
    if (!place) continue;
    const Place where{*place, 0, false, true};
    const Reading reading = read_length(search_.candidate(age).length_ticks, where);
    if (!reading.plausible) continue;
    const TrackedFlash flash = accept(search_.candidate(age), where, reading, counters);
    if (age == 0) newest = flash;
  }
  counters.flashes_missed = missed;
  locked_ = true;
  ++counters.locks;
  return newest;
}

void SlotTracker::lose(DecoderCounters& counters) {
  locked_ = false;
  ++counters.locks_lost;
}

bool SlotTracker::supersedes(const SlotPattern& pattern) const {
  if (!locked_) return true;
  const std::uint32_t explained_now = static_cast<std::uint32_t>(search_.size()) - search_.rejected();
  return pattern.explained >= explained_now + kSupersedesBy;
}

std::optional<TrackedFlash> SlotTracker::push(const FlashCandidate& candidate, DecoderCounters& counters) {
  constexpr std::int64_t kLongestGap = std::int64_t{RotorClock::kLongestGapTurns} * kTurn_ticks;
  if (locked_ && candidate.start_ticks - last_flash_ticks_ > kLongestGap) {
    lose(counters);
  }
  // Times of flashes never run backwards, whatever the time base was for a moment.
  const bool in_order = candidate.start_ticks > last_flash_ticks_;
  Place expected;
  if (locked_ && in_order) expected = expected_place(candidate.start_ticks);
  Reading reading;
  if (expected.found) reading = read_length(candidate.length_ticks, expected);
  const bool accepted = expected.found && reading.plausible;
  search_.push(candidate, accepted);
  if (accepted) {
    ++counters.flashes;
    return accept(candidate, expected, reading, counters);
  }
  if (in_order && (!locked_ || search_.recently_rejected() >= kSuspiciousRejections)) {
    const auto pattern = search_.find();
    if (pattern && supersedes(*pattern)) {
      const auto flash = adopt(*pattern, counters);
      if (flash) {
        ++counters.flashes;
        return flash;
      }
    }
  }
  ++(locked_ ? counters.flashes_rejected : counters.flashes_before_lock);
  return std::nullopt;
}

LockState SlotTracker::lock(std::int64_t now_ticks) const {
  LockState state;
  state.locked = locked_;
  for (std::size_t position = 0; position < kMaxStations; ++position) {
    const Station& station = station_[position];
    if (!locked_ || !station.known) continue;
    const RotorClock& rotor = station.rotor[station.last_slot & 1U];
    const std::int64_t gone = std::max<std::int64_t>(0, now_ticks - rotor.last_ticks()) / kSlot_ticks;
    const std::uint32_t seen = gone < 32 ? station.seen << static_cast<std::uint32_t>(gone) : 0U;
    LockState::Station& out = state.station[number_[position]];
    out.quality = static_cast<std::uint8_t>(std::popcount(recent(seen)));
    out.seen = out.quality > 0;
  }
  return state;
}

}  // namespace pharos::lighthouse
