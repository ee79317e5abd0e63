// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/light_event.hpp"

namespace pharos::lighthouse {

/// Puts events in the order of their stamps. Made for input that is nearly sorted: an event in order costs one
/// comparison, a late event is inserted in order.
///
/// Events held at one time lie within seconds of one another (the time base ensures it), so 32 bits of their stamps are
/// kept and the rest follows from the newest one: 8 bytes an event, and short sums on a 32-bit core.
///
/// When full (350 us of pulses from 32 sensors do not fill it) the caller takes the oldest out early.
class ReorderBuffer {
 public:
  enum class Verdict : std::uint8_t { kTaken, kDoubled, kLate };
  static constexpr std::size_t kCapacity = 128;

  /// Takes an event that is newer than all that are held, as most are; false, and nothing done, for any other.
  bool append(const LightEvent& event) {
    const Held held = packed(event);
    const std::int32_t after = ticks_difference(held.stamp, newest_.stamp);
    // Edges of one tick mostly arrive by rising sensor: one of a higher sensor is not a duplicate.
    const bool further = after > 0 || (after == 0 && held.what > newest_.what && held.what >= kFirstEdge);
    if (!further || size_ - 1 >= kCapacity - 1) return false;  // none held, or full
    newest_.stamp = held.stamp;
    newest_.what = held.what;
    reference_ticks_ = event.stamp_ticks;
    Held& place = at(size_++);
    place.stamp = held.stamp;
    place.what = held.what;
    return true;
  }
  /// Takes any event. Must not be called when full().
  Verdict insert(const LightEvent& event);

  /// The oldest event's stamp; there must be one.
  std::int64_t oldest_ticks() const { return unpacked_stamp(events_[head_].stamp); }
  /// Whether the oldest event is of `stamp` (the low word of a time within seconds of all that are held) or before.
  bool oldest_is_by(std::uint32_t stamp) const { return ticks_difference(stamp, events_[head_].stamp) >= 0; }
  std::uint32_t oldest_stamp() const { return events_[head_].stamp; }
  std::uint32_t newest_stamp() const { return newest_.stamp; }
  LightEvent pop() {
    const LightEvent event = unpacked(events_[head_]);
    head_ = (head_ + 1) % kCapacity;
    --size_;
    released_ticks_ = event.stamp_ticks;
    return event;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }

  /// The time base moved to `ticks` (earlier or later than before): events before it are accepted again.
  void restart_at(std::int64_t ticks) {
    if (ticks < released_ticks_) released_ticks_ = ticks;
  }
  /// Removes the newest event if it is later than `ticks`.
  bool drop_after(std::int64_t ticks, LightEvent& dropped);

 private:
  struct Held {
    std::uint32_t stamp = 0;
    std::uint32_t what = 0;  // kind, sensor, width from the top: 8, 8, 16 bits
  };
  static constexpr std::uint32_t kFirstEdge = std::uint32_t{1} << 24U;

  static Held packed(const LightEvent& event) {
    return {static_cast<std::uint32_t>(event.stamp_ticks),
            static_cast<std::uint32_t>(event.kind) << 24U | std::uint32_t{event.sensor} << 16U | event.width_ticks};
  }
  std::int64_t unpacked_stamp(std::uint32_t stamp) const {
    return reference_ticks_ + ticks_difference(stamp, static_cast<std::uint32_t>(reference_ticks_));
  }
  LightEvent unpacked(const Held& held) const {
    return {unpacked_stamp(held.stamp), static_cast<std::uint16_t>(held.what),
            static_cast<std::uint8_t>(held.what >> 16U), static_cast<LightEvent::Kind>(held.what >> 24U)};
  }
  Held& at(std::size_t index) { return events_[(head_ + index) % kCapacity]; }
  const Held& at(std::size_t index) const { return events_[(head_ + index) % kCapacity]; }

  std::size_t head_ = 0;
  std::size_t size_ = 0;
  Held newest_;  // while any is held: the newest stamp, and the largest `what` of those that share it
  std::int64_t reference_ticks_ = 0;  // of the event last taken in
  std::int64_t released_ticks_ = INT64_MIN;
  std::array<Held, kCapacity> events_{};
};

}  // namespace pharos::lighthouse
