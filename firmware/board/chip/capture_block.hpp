// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/board/rv32/mmio.hpp"
#include "firmware/hal/edge_capture.hpp"
#include "firmware/rtl/capture_registers.h"

namespace pharos::board {

/// The capture block on the bus (firmware/rtl).
class CaptureBlock final : public hal::EdgeCapture {
 public:
  explicit constexpr CaptureBlock(std::uintptr_t base) : base_(base) {}

  /// False when there is no block of this map.
  bool start() {
    const std::uint32_t version = at(PHAROS_CAPTURE_BUILD_OFFSET) >> PHAROS_CAPTURE_BUILD_VERSION_SHIFT;
    if (at(PHAROS_CAPTURE_ID_OFFSET) != PHAROS_CAPTURE_ID || version != PHAROS_CAPTURE_VERSION) return false;
    at(PHAROS_CAPTURE_CONTROL_OFFSET) = PHAROS_CAPTURE_CONTROL_ENABLE | PHAROS_CAPTURE_CONTROL_CLEAR_FIFO;
    return true;
  }
  bool read(hal::CaptureRecord& record) override {
    const std::uint32_t status = at(PHAROS_CAPTURE_STATUS_OFFSET);
    if ((status & PHAROS_CAPTURE_STATUS_COUNT_MASK) == 0) return false;
    record.gap = (status & PHAROS_CAPTURE_STATUS_GAP) != 0;
    record.time_ticks = at(PHAROS_CAPTURE_FIFO_TIME_OFFSET);
    record.changed = at(PHAROS_CAPTURE_FIFO_CHANGED_OFFSET);
    record.levels = at(PHAROS_CAPTURE_FIFO_LEVELS_OFFSET);  // removes it
    return true;
  }
  std::int64_t now_ticks() override {
    const std::uint32_t low = at(PHAROS_CAPTURE_TIME_LOW_OFFSET);  // latches the high word
    return static_cast<std::int64_t>((std::uint64_t{at(PHAROS_CAPTURE_TIME_HIGH_OFFSET)} << 32) | low);
  }
  std::uint32_t edges_lost() override { return at(PHAROS_CAPTURE_LOST_OFFSET); }
  bool take_overflow() override {
    const bool any = (at(PHAROS_CAPTURE_STATUS_OFFSET) & PHAROS_CAPTURE_STATUS_OVERFLOW) != 0;
    if (any) at(PHAROS_CAPTURE_STATUS_OFFSET) = PHAROS_CAPTURE_STATUS_OVERFLOW;
    return any;
  }
  std::uint32_t inputs() override {
    const std::uint32_t count = at(PHAROS_CAPTURE_BUILD_OFFSET) & PHAROS_CAPTURE_BUILD_INPUTS_MASK;
    return count >= 32 ? UINT32_MAX : (1U << count) - 1;
  }

 private:
  volatile std::uint32_t& at(std::uintptr_t offset) const { return mmio32(base_ + offset); }

  std::uintptr_t base_;
};

}  // namespace pharos::board
