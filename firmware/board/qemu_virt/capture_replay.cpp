// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/qemu_virt/capture_replay.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/rtl/capture_registers.h"
#include "pharos/base/ticks.hpp"

namespace pharos::board {
namespace {

constexpr std::uint32_t kSpeed = 0xFFFFFFFE;
constexpr std::uint32_t kEnd = 0xFFFFFFFF;

}  // namespace

void CaptureReplay::start() {
  if (!console_.start()) return;
  while (!held_ && now_ticks_ == 0 && !ended_) {
    if (const PausedClock aside(*this); take_words(aside.begin() - instructions_)) continue;
    set_timer(machine_ticks() + kTicksPerSecond / 1000);
    wait_for_interrupt();
  }
}

// Fetches the next words, if they arrived whole. True when it did.
bool CaptureReplay::fetch() {
  const auto bytes = std::as_writable_bytes(std::span(words_));
  while (count_ < bytes.size()) {
    const auto come = console_.read(bytes.size() - count_);
    waiting_ = come.empty();
    // A tape with a core's speed is whole: waiting for the rest of it, for however long, changes no frame.
    if (waiting_ && speed_ != 0) continue;
    if (waiting_) return false;
    for (const volatile std::uint8_t& byte : come) bytes[count_++] = std::byte{byte};
    if (count_ < bytes.size()) continue;
    const std::uint32_t status = words_[0];
    if (status == kSpeed) {
      speed_ = words_[1];
      millisecond_ = kTicksPerSecond / 1000 * 1024 / speed_;
      count_ = 0;
    } else if (status == kEnd) {
      due_ticks_ = now_ticks_;
    } else if ((status & PHAROS_CAPTURE_STATUS_COUNT_MASK) != 0) {
      due_ticks_ = now_ticks_ + ticks_difference(words_[1], static_cast<std::uint32_t>(now_ticks_));
    } else {
      due_ticks_ = static_cast<std::int64_t>(std::uint64_t{words_[2]} << 32 | words_[1]);
    }
  }
  return true;
}

// Consumes the words.
void CaptureReplay::use() {
  count_ = 0;
  now_ticks_ = due_ticks_;
  const std::uint32_t status = words_[0];
  if (status == kEnd) {
    ended_ = true;
    return;
  }
  const bool overflow = (status & PHAROS_CAPTURE_STATUS_OVERFLOW) != 0;
  new_overflow_ = new_overflow_ || (overflow && !overflow_);
  overflow_ = overflow;
  held_ = (status & PHAROS_CAPTURE_STATUS_COUNT_MASK) != 0;
  if (!held_) lost_ = words_[3];
}

// Takes the next words, where there are any and their time has come. True when it did.
bool CaptureReplay::take_words(std::uint32_t instructions) {
  const bool first = now_ticks_ == 0;
  const bool come = fetch();
  if (come && speed_ != 0 && !first && due_ticks_ > core_ticks(instructions)) return false;
  if (come) use();
  if (first || !come) {  // where nothing arrived, the core is not late
    core_ticks_ = now_ticks_;
    core_begin_ = instructions;
  }
  return come;
}

// The core's own time: it advances with the instructions.
std::int64_t CaptureReplay::core_ticks(std::uint32_t instructions) {
  const std::uint64_t moved = std::uint64_t{instructions - core_begin_} * speed_ + core_fraction_;
  core_begin_ = instructions;
  core_fraction_ = static_cast<std::uint32_t>(moved % 1024);
  core_ticks_ += static_cast<std::int64_t>(moved / 1024);
  return core_ticks_;
}

std::int64_t CaptureReplay::now_ticks() {
  // Never beyond the next known record: until then nothing changes.
  if (speed_ != 0 && !held_ && count_ == sizeof(words_)) {
    const PausedClock aside(*this);
    now_ticks_ = std::max(now_ticks_, std::min(core_ticks(aside.begin() - instructions_), due_ticks_));
  }
  return now_ticks_;
}

// Cost on a board, uncounted instructions excluded: a status, and three registers where there is a record.
bool CaptureReplay::read(hal::CaptureRecord& record) {
  if (!held_ && !ended_) {
    const PausedClock aside(*this);
    take_words(aside.begin() - instructions_);
  }
  if (!held_) return false;
  held_ = false;
  record.time_ticks = words_[1];
  record.changed = words_[2];
  record.levels = words_[3];
  record.gap = (words_[0] & PHAROS_CAPTURE_STATUS_GAP) != 0;
  return true;
}

bool CaptureReplay::take_overflow() {
  const bool rose = new_overflow_;
  new_overflow_ = false;
  return rose;
}

}  // namespace pharos::board
