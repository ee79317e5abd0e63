// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/slot_search.hpp"

#include <bit>

namespace pharos::lighthouse {
namespace {

/// Flashes of one station's two rotors are within 470 ticks of half a revolution apart (99 %), and drift further over a
/// few revolutions.
constexpr std::int32_t kTrainTolerance_ticks = 1000;
/// Extremes of the second station's lag are within 700 of the median; the rotors' own spread is added.
constexpr std::int32_t kCompanionTolerance_ticks = 1700;
/// Real lengths are off nominal by -47..+78 on a strong sensor, less on a weak one; half a step of axis is 260.
constexpr std::int32_t kLengthTolerance_ticks = 259;
constexpr std::uint32_t kRecent = 12;
/// Older groups are useless: rotors drift out of the tolerances above.
constexpr std::int32_t kOldestSlots = 24;

bool length_fits(std::int32_t length, Axis axis, bool skip) {
  for (const bool data : {false, true}) {
    const std::int32_t off = length - kFlashLength_ticks[flash_code(axis, data, skip)];
    if (off <= kLengthTolerance_ticks && off >= -kLengthTolerance_ticks) return true;
  }
  return false;
}

std::uint32_t nearest_code(std::int32_t length) {
  std::uint32_t code = 0;
  while (code < 7 && length > (kFlashLength_ticks[code] + kFlashLength_ticks[code + 1]) / 2) ++code;
  return code;
}

}  // namespace

void SlotSearch::push(const FlashCandidate& candidate, bool accepted) {
  newest_ = (newest_ + 1) % kMaxHistory;
  entries_[newest_] = candidate;
  if (size_ < kMaxHistory) ++size_;
  verdicts_ = (verdicts_ << 1U) | (accepted ? 0U : 1U);
}

std::uint32_t SlotSearch::recently_rejected() const {
  return static_cast<std::uint32_t>(std::popcount(verdicts_ & ((1U << kRecent) - 1U)));
}

std::uint32_t SlotSearch::rejected() const {
  return static_cast<std::uint32_t>(std::popcount(verdicts_ & ((1U << size_) - 1U)));
}

std::optional<SlotPlace> SlotSearch::place(std::size_t age, const SlotPattern& pattern) const {
  // Time before the newest group, relative to the first flash of the slot so that it only grows with the age.
  const std::int64_t before = candidate(0).start_ticks - candidate(age).start_ticks;
  for (const std::uint8_t position : {std::uint8_t{0}, std::uint8_t{1}}) {
    const bool companion = position != pattern.newest.position;
    if (companion && pattern.kind != SlotPattern::Kind::kBoth) continue;
    const std::int64_t lag = std::int64_t{position - pattern.newest.position} * kSecondFlash_ticks;
    const std::int64_t whole = before + lag;
    const std::int32_t tolerance = companion ? kCompanionTolerance_ticks : kTrainTolerance_ticks;
    if (whole < -tolerance || whole > kOldestSlots * kSlot_ticks + tolerance) continue;
    const auto ticks = static_cast<std::int32_t>(whole);
    const std::int32_t slots = (ticks + kSlot_ticks / 2) / kSlot_ticks;
    const std::int32_t off = ticks - slots * kSlot_ticks;
    if (off <= tolerance && off >= -tolerance) {
      return SlotPlace{position, pattern.newest.slot - static_cast<std::uint32_t>(slots)};
    }
  }
  return std::nullopt;
}

std::optional<SlotPattern> SlotSearch::evaluate(const SlotPattern& hypothesis) const {
  std::array<std::uint32_t, 2> fit{};
  std::uint32_t wrong_length = 0;
  std::uint32_t residues = 0;
  for (std::size_t age = 0; age < size_; ++age) {
    const auto place_then = place(age, hypothesis);
    if (!place_then) continue;
    const bool never_skips = hypothesis.kind == SlotPattern::Kind::kNeverSkips;
    const bool skip = !never_skips && skip_of_slot(place_then->slot, place_then->position);
    if (length_fits(candidate(age).length_ticks, axis_of_slot(place_then->slot), skip)) {
      ++fit[place_then->position];
      residues |= 1U << (place_then->slot & 3U);
    } else {
      ++wrong_length;
    }
  }
  const std::uint32_t own = fit[hypothesis.newest.position];
  const std::uint32_t companion = fit[1U - hypothesis.newest.position];
  SlotPattern found = hypothesis;
  found.explained = static_cast<std::uint8_t>(own + companion);
  if (wrong_length * 6 > own + companion) return std::nullopt;
  switch (hypothesis.kind) {
    case SlotPattern::Kind::kBoth:
      // Seven of at most 16, both stations among them: no other phase of the cycle fits so many lengths.
      if (own < 3 || companion < 3 || own + companion < 7) return std::nullopt;
      break;
    case SlotPattern::Kind::kNeverSkips:
      // All four slots of the cycle without a skip: one of two stations shows a skip within three slots.
      if (own < 5 || residues != 0xF) return std::nullopt;
      break;
    case SlotPattern::Kind::kOneOfTwo:
      // The other is hidden or off: wait for it as long as the guaranteed 12 flashes allow.
      if (own < 10 || residues != 0xF) return std::nullopt;
      break;
  }
  return found;
}

std::optional<SlotPattern> SlotSearch::find() const {
  if (size_ == 0) return std::nullopt;
  const std::uint32_t code = nearest_code(candidate(0).length_ticks);
  const std::uint32_t axis = code & 1U;
  const bool skip = (code & 4U) != 0;
  SlotPattern best;
  for (const std::uint8_t position : {std::uint8_t{0}, std::uint8_t{1}}) {
    const std::uint32_t half = skip == (position == 1) ? 2U : 0U;
    const auto found = evaluate({SlotPattern::Kind::kBoth, {position, axis | half}, 0});
    if (found && found->explained > best.explained) best = *found;
  }
  if (best.explained > 0) return best;
  if (!skip) {
    if (const auto found = evaluate({SlotPattern::Kind::kNeverSkips, {0, axis}, 0})) return found;
  }
  const std::uint32_t half = skip ? 0U : 2U;
  return evaluate({SlotPattern::Kind::kOneOfTwo, {0, axis | half}, 0});
}

}  // namespace pharos::lighthouse
