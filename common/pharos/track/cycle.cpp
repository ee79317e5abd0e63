// SPDX-License-Identifier: Apache-2.0
#include "pharos/track/cycle.hpp"

namespace pharos::track {

bool CycleAssembler::fits(Axis axis, std::int64_t flash_ticks) const {
  if (!is_open_) return true;
  const std::int64_t gap = flash_ticks - open_.last_flash_ticks;
  return axis == Axis::kY && !open_.has_sweep[1] && gap > 0 && gap < kMaxGap_ticks;
}

const Cycle* CycleAssembler::close_before(Axis axis, std::int64_t flash_ticks) {
  if (fits(axis, flash_ticks)) return nullptr;
  is_open_ = false;
  return &open_;
}

const Cycle* CycleAssembler::add(std::uint8_t station, Axis axis, std::int64_t flash_ticks, std::uint8_t sweep_flags,
                                 const lighthouse::SweepBearings& bearings, bool may_complete) {
  if (!is_open_) {
    open_.sweep_flags = 0;
    open_.has_sweep = {};
    for (lighthouse::SweepBearings& old : open_.bearings) old.clear();
  }
  open_.station = station;
  open_.sweep_flags |= sweep_flags;
  open_.last_flash_ticks = flash_ticks;
  const auto index = static_cast<std::size_t>(index_of(axis));
  open_.has_sweep[index] = true;
  open_.bearings[index] = bearings;
  is_open_ = axis != Axis::kY || !may_complete;
  return is_open_ ? nullptr : &open_;
}

std::optional<Cycle> CycleAssembler::push(std::uint8_t station, Axis axis, std::int64_t flash_ticks,
                                          std::uint8_t sweep_flags, const lighthouse::SweepBearings& bearings) {
  std::optional<Cycle> closed;
  if (const Cycle* left = close_before(axis, flash_ticks)) closed = *left;
  if (const Cycle* whole = add(station, axis, flash_ticks, sweep_flags, bearings, !closed)) closed = *whole;
  return closed;
}

std::optional<Cycle> CycleAssembler::flush() {
  if (!is_open_) return std::nullopt;
  is_open_ = false;
  return open_;
}

}  // namespace pharos::track
