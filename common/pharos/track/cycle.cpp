// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/cycle.hpp"

namespace pharos::track {

bool CycleAssembler::fits(Axis axis, std::int64_t flash_ticks) const {
  if (!is_open_) return true;
  const std::int64_t gap = flash_ticks - open_.last_flash_ticks;
  return axis == Axis::kY && !open_.has_sweep[1] && gap > 0 && gap < kMaxGapTicks;
}

std::optional<Cycle> CycleAssembler::push(std::uint8_t station, Axis axis, std::int64_t flash_ticks,
                                          std::uint8_t sweep_flags, const lighthouse::SweepBearings& bearings) {
  std::optional<Cycle> closed;
  if (!fits(axis, flash_ticks)) closed = flush();
  if (!is_open_) open_ = Cycle{};
  is_open_ = true;
  open_.station = station;
  open_.sweep_flags |= sweep_flags;
  open_.last_flash_ticks = flash_ticks;
  const auto index = static_cast<std::size_t>(index_of(axis));
  open_.has_sweep[index] = true;
  open_.bearings[index] = bearings;
  // When the new sweep had to push an older one out, it waits for its own partner or for the next push.
  if (axis == Axis::kY && !closed) closed = flush();
  return closed;
}

std::optional<Cycle> CycleAssembler::flush() {
  if (!is_open_) return std::nullopt;
  is_open_ = false;
  return open_;
}

}  // namespace pharos::track
