// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/lighthouse/light_event.hpp"

namespace pharos::lighthouse {

/// Puts events in the order of their stamps. Made for input that is nearly sorted: an event that comes in order costs
/// one comparison, one that comes late is shifted past its elders.
///
/// Policy when full (which 350 us of light from 32 sensors do not do): the caller takes the oldest out before its time.
class EventOrder {
 public:
  enum class Verdict : std::uint8_t { kTaken, kDoubled, kLate };
  static constexpr std::size_t kCapacity = 128;

  /// Must not be called when full().
  Verdict insert(const LightEvent& event) {
    if (event.stamp_ticks < given_out_ticks_) return Verdict::kLate;
    std::size_t place = size_;
    while (place > 0 && at(place - 1).stamp_ticks > event.stamp_ticks) --place;
    for (std::size_t i = place; i > 0 && at(i - 1).stamp_ticks == event.stamp_ticks; --i) {
      if (at(i - 1).same_as(event)) return Verdict::kDoubled;
    }
    for (std::size_t i = size_; i > place; --i) at(i) = at(i - 1);
    at(place) = event;
    ++size_;
    return Verdict::kTaken;
  }
  bool has_before(std::int64_t stamp_ticks) const { return size_ > 0 && at(0).stamp_ticks <= stamp_ticks; }
  LightEvent pop() {
    const LightEvent event = at(0);
    head_ = (head_ + 1) % kCapacity;
    --size_;
    given_out_ticks_ = event.stamp_ticks;
    return event;
  }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }

  /// Time was found to be `ticks` (earlier or later than thought): events before it are welcome again.
  void restart_at(std::int64_t ticks) {
    if (ticks < given_out_ticks_) given_out_ticks_ = ticks;
  }
  /// Removes the newest event if it lies behind `ticks`.
  bool drop_after(std::int64_t ticks, LightEvent& dropped) {
    if (size_ == 0 || at(size_ - 1).stamp_ticks <= ticks) return false;
    dropped = at(--size_);
    return true;
  }

 private:
  LightEvent& at(std::size_t index) { return events_[(head_ + index) % kCapacity]; }
  const LightEvent& at(std::size_t index) const { return events_[(head_ + index) % kCapacity]; }

  std::array<LightEvent, kCapacity> events_{};
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::int64_t given_out_ticks_ = INT64_MIN;
};

}  // namespace pharos::lighthouse
