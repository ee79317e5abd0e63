// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/flash_grouping.hpp"

namespace pharos::lighthouse {

/// Position of a flash in the slot cycle.
///
/// Slots are numbered so that bit 0 is the axis and, with two stations, bit 1 is the one that sweeps: the first station
/// is dark (skip) in slots 0 and 1 of four, the second in slots 2 and 3. A lone station in mode A is never dark.
struct SlotPlace {
  std::uint8_t position = 0;  // 0 first flash of the slot, 1 second
  std::uint32_t slot = 0;
};

constexpr Axis axis_of_slot(std::uint32_t slot) { return (slot & 1U) != 0 ? Axis::kY : Axis::kX; }
constexpr bool skip_of_slot(std::uint32_t slot, std::uint8_t position) { return ((slot & 2U) != 0) == (position == 1); }

/// The cycle that explains the last flash groups.
struct SlotPattern {
  /// Which flashes were seen: both stations', one that never skips, or one of two.
  enum class Kind : std::uint8_t { kBoth, kNeverSkips, kOneOfTwo };
  Kind kind = Kind::kNeverSkips;
  SlotPlace newest;            // of the newest group
  std::uint8_t explained = 0;  // groups that fit, of the last kMaxHistory
};

/// The last flash groups, and the search for the slot cycle in them when nothing is locked.
class SlotSearch {
 public:
  static constexpr std::size_t kMaxHistory = 16;

  void push(const FlashCandidate& candidate, bool accepted);
  /// Groups among the last 12 that did not fit the present lock.
  std::uint32_t recently_rejected() const;
  std::uint32_t rejected() const;  // in the whole history
  /// The cycle that ends with the newest group, if it is unambiguous.
  std::optional<SlotPattern> find() const;
  std::size_t size() const { return size_; }
  /// Group `age` (0 the newest); its position under `pattern`, if it has one.
  const FlashCandidate& candidate(std::size_t age) const {
    return entries_[(newest_ + kMaxHistory - age) % kMaxHistory];
  }
  std::optional<SlotPlace> place(std::size_t age, const SlotPattern& pattern) const;
  void clear() {
    size_ = 0;
    verdicts_ = 0;
  }

 private:
  std::optional<SlotPattern> evaluate(const SlotPattern& hypothesis) const;

  std::array<FlashCandidate, kMaxHistory> entries_{};
  std::size_t newest_ = 0;
  std::size_t size_ = 0;
  std::uint32_t verdicts_ = 0;  // bit 0 newest; 1 = rejected
};

}  // namespace pharos::lighthouse
