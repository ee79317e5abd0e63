// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/qemu_virt/capture_tape.hpp"

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/rtl/capture_registers.h"
#include "pharos/base/ticks.hpp"

namespace pharos::board {
namespace {

constexpr std::uint32_t kEnd = 0xFFFFFFFF;

std::uint32_t word(const std::array<std::uint8_t, 16>& bytes, std::size_t index) {
  const std::uint8_t* at = &bytes[4 * index];
  return std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 | std::uint32_t{at[3]} << 24;
}

}  // namespace

void CaptureTape::start() {
  if (!console_.start()) return;
  while (!held_ && now_ticks_ == 0 && !ended_) {
    if (next()) continue;
    set_timer(machine_ticks() + kTicksPerSecond / 1000);
    wait_for_interrupt();
  }
}

bool CaptureTape::next() {
  const auto before = static_cast<std::uint32_t>(instructions_retired());
  const bool any = take_words();
  instructions_ += static_cast<std::uint32_t>(instructions_retired()) - before;
  return any;
}

// Takes the next words, if they have come whole. True when they were.
bool CaptureTape::take_words() {
  while (count_ < bytes_.size()) {
    const auto come = console_.read(bytes_.size() - count_);
    waiting_ = come.empty();
    if (waiting_) return false;
    for (const volatile std::uint8_t& byte : come) bytes_[count_++] = byte;
  }
  count_ = 0;
  const std::uint32_t status = word(bytes_, 0);
  if (status == kEnd) {
    ended_ = true;
    return true;
  }
  const bool overflow = (status & PHAROS_CAPTURE_STATUS_OVERFLOW) != 0;
  new_overflow_ = new_overflow_ || (overflow && !overflow_);
  overflow_ = overflow;
  held_ = (status & PHAROS_CAPTURE_STATUS_COUNT_MASK) != 0;
  if (held_) {
    now_ticks_ += ticks_difference(word(bytes_, 1), static_cast<std::uint32_t>(now_ticks_));
  } else {
    now_ticks_ = static_cast<std::int64_t>(std::uint64_t{word(bytes_, 2)} << 32 | word(bytes_, 1));
    lost_ = word(bytes_, 3);
  }
  return true;
}

bool CaptureTape::read(hal::CaptureRecord& record) {
  if (!held_ && (ended_ || !next() || !held_)) return false;
  held_ = false;
  record.time_ticks = word(bytes_, 1);
  record.changed = word(bytes_, 2);
  record.levels = word(bytes_, 3);
  record.gap = (word(bytes_, 0) & PHAROS_CAPTURE_STATUS_GAP) != 0;
  return true;
}

bool CaptureTape::take_overflow() {
  const bool rose = new_overflow_;
  new_overflow_ = false;
  return rose;
}

}  // namespace pharos::board
