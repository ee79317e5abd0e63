// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/light_event.hpp"

namespace pharos::lighthouse {

/// Puts events in the order of their stamps. Made for input that is nearly sorted: an event that comes in order costs
/// one comparison, one that comes late is shifted past its elders.
///
/// Events held at one time lie within seconds of one another (the time base sees to that), so 32 bits of their stamps
/// are kept and the rest is known from the newest one taken: 8 bytes an event, and short sums on a 32-bit core.
///
/// Policy when full (which 350 us of light from 32 sensors do not do): the caller takes the oldest out before its time.
class EventOrder {
 public:
  enum class Verdict : std::uint8_t { kTaken, kDoubled, kLate };
  static constexpr std::size_t kCapacity = 128;

  /// Must not be called when full().
  Verdict insert(const LightEvent& event) {
    if (event.stamp_ticks < given_out_ticks_) return Verdict::kLate;
    const Held held{static_cast<std::uint32_t>(event.stamp_ticks), event.width_ticks, event.sensor, event.kind};
    std::size_t place = size_;
    while (place > 0 && ticks_difference(at(place - 1).stamp, held.stamp) > 0) --place;
    for (std::size_t i = place; i > 0 && at(i - 1).stamp == held.stamp; --i) {
      if (at(i - 1).sensor == held.sensor && at(i - 1).kind == held.kind) return Verdict::kDoubled;
    }
    for (std::size_t i = size_; i > place; --i) at(i) = at(i - 1);
    at(place) = held;
    ++size_;
    reference_ticks_ = event.stamp_ticks;
    return Verdict::kTaken;
  }
  bool has_before(std::int64_t stamp_ticks) const { return size_ > 0 && whole_stamp(at(0)) <= stamp_ticks; }
  LightEvent pop() {
    const LightEvent event = whole(at(0));
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
    if (size_ == 0 || whole_stamp(at(size_ - 1)) <= ticks) return false;
    dropped = whole(at(--size_));
    return true;
  }

 private:
  struct Held {
    std::uint32_t stamp = 0;
    std::uint16_t width_ticks = 0;
    std::uint8_t sensor = 0;
    LightEvent::Kind kind = LightEvent::Kind::kPulse;
  };

  std::int64_t whole_stamp(const Held& held) const {
    return reference_ticks_ + ticks_difference(held.stamp, static_cast<std::uint32_t>(reference_ticks_));
  }
  LightEvent whole(const Held& held) const { return {whole_stamp(held), held.width_ticks, held.sensor, held.kind}; }
  Held& at(std::size_t index) { return events_[(head_ + index) % kCapacity]; }
  const Held& at(std::size_t index) const { return events_[(head_ + index) % kCapacity]; }

  std::array<Held, kCapacity> events_{};
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::int64_t given_out_ticks_ = INT64_MIN;
  std::int64_t reference_ticks_ = 0;  // of the event last taken in
};

}  // namespace pharos::lighthouse
