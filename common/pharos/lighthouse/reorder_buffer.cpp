// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/reorder_buffer.hpp"

namespace pharos::lighthouse {

ReorderBuffer::Verdict ReorderBuffer::insert(const LightEvent& event) {
  if (event.stamp_ticks < released_ticks_) return Verdict::kLate;
  const Held held = packed(event);
  std::size_t place = size_;
  while (place > 0 && ticks_difference(at(place - 1).stamp, held.stamp) > 0) --place;
  for (std::size_t i = place; i > 0 && at(i - 1).stamp == held.stamp; --i) {
    if (at(i - 1).what >> 16U == held.what >> 16U) return Verdict::kDoubled;
  }
  for (std::size_t i = size_; i > place; --i) at(i) = at(i - 1);
  at(place) = held;
  if (place == size_ && (place == 0 || held.stamp != newest_.stamp || held.what > newest_.what)) newest_ = held;
  ++size_;
  reference_ticks_ = event.stamp_ticks;
  return Verdict::kTaken;
}

bool ReorderBuffer::drop_after(std::int64_t ticks, LightEvent& dropped) {
  if (size_ == 0 || unpacked_stamp(at(size_ - 1).stamp) <= ticks) return false;
  dropped = unpacked(at(--size_));
  // An upper bound of `what` for events with the newest stamp.
  if (size_ > 0) newest_ = {at(size_ - 1).stamp, UINT32_MAX};
  return true;
}

}  // namespace pharos::lighthouse
