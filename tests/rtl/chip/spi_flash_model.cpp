// SPDX-License-Identifier: Apache-2.0
#include "rtl/chip/spi_flash_model.hpp"

#include <algorithm>
#include <utility>

namespace pharos::rtl {
namespace {

constexpr std::uint8_t kProgram = 0x02;
constexpr std::uint8_t kRead = 0x03;
constexpr std::uint8_t kReadStatus = 0x05;
constexpr std::uint8_t kWriteEnable = 0x06;
constexpr std::uint8_t kErase = 0xD8;
constexpr std::uint32_t kPage = 256;
constexpr std::uint32_t kSector = 65'536;

}  // namespace

bool SpiFlashModel::tick(bool select_n, bool clock, bool in) {
  ++now_;
  if (busy_ticks_ != 0) --busy_ticks_;
  if (select_n) {
    if (selected_ && bits_ == 0) execute();
    selected_ = false;
    last_clock_ = clock;
    level_ = true;
    return level_;
  }
  if (!selected_) {
    selected_ = true;
    bits_ = 0;
    bytes_ = 0;
    command_ = 0;
    page_.clear();
    out_ = 0xFF;
  }
  if (clock && !last_clock_) {
    in_ = static_cast<std::uint8_t>(in_ << 1 | (in ? 1 : 0));
    if (++bits_ == 8) {
      bits_ = 0;
      take_byte(in_);
    }
  } else if (!clock && last_clock_) {
    level_ = (out_ & 0x80) != 0;
    out_ = static_cast<std::uint8_t>(out_ << 1 | 1);
  }
  last_clock_ = clock;
  return level_;
}

void SpiFlashModel::take_byte(std::uint8_t byte) {
  const std::uint32_t number = bytes_++;
  out_ = 0xFF;
  if (number == 0) {
    command_ = byte;
    address_ = 0;
  } else if (command_ != kReadStatus && number < 4) {
    address_ = address_ << 8 | byte;
  } else if (command_ == kProgram) {
    page_.push_back(byte);
  }
  if (command_ == kReadStatus) {
    out_ = static_cast<std::uint8_t>((busy_ticks_ != 0 ? 1 : 0) | (writable_ ? 2 : 0));
  } else if (command_ == kRead && number >= 3 && busy_ticks_ == 0) {
    const std::size_t at = address_++ % content_.size();
    out_ = content_[at];
    if (!unstable.empty()) out_ = static_cast<std::uint8_t>(out_ ^ (unstable[at] & noise_()));
  }
}

void SpiFlashModel::execute() {
  if (busy_ticks_ != 0 || bytes_ == 0) return;
  if (command_ == kWriteEnable && bytes_ == 1) writable_ = true;
  if (!writable_) return;
  if (command_ == kProgram && bytes_ > 4) {
    const std::size_t begin = address_ / kPage * kPage % content_.size();
    std::vector<std::uint8_t> after(&content_[begin], &content_[begin] + kPage);
    for (std::uint32_t i = 0; i < page_.size(); ++i) after[(address_ + i) % kPage] &= page_[i];
    change(begin, std::move(after), program_ticks);
  } else if (command_ == kErase && bytes_ == 4) {
    const std::size_t begin = address_ / kSector * kSector % content_.size();
    change(begin, std::vector<std::uint8_t>(kSector, 0xFF), erase_ticks);
  }
}

void SpiFlashModel::change(std::size_t offset, std::vector<std::uint8_t> after, std::uint32_t ticks) {
  std::vector<std::uint8_t> before(&content_[offset], &content_[offset] + after.size());
  std::ranges::copy(after, &content_[offset]);
  changes_.push_back({now_, now_ + ticks, offset, std::move(before), std::move(after)});
  busy_ticks_ = ticks;
  writable_ = false;
}

}  // namespace pharos::rtl
