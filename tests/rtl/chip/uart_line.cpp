// SPDX-License-Identifier: Apache-2.0
#include "rtl/chip/uart_line.hpp"

namespace pharos::rtl {

std::optional<std::uint8_t> UartLine::receive(bool level) {
  if (!receiving_) {
    if (last_ && !level) {
      receiving_ = true;
      now_ = 0.0;
      next_sample_ = 1.5 * bit_ticks_;
      sampled_ = 0;
      bits_ = 0;
    }
    last_ = level;
    return std::nullopt;
  }
  last_ = level;
  now_ += 1.0;
  if (now_ < next_sample_) return std::nullopt;
  next_sample_ += bit_ticks_;
  if (sampled_ < 8) {
    bits_ |= static_cast<std::uint32_t>(level) << sampled_++;
    return std::nullopt;
  }
  receiving_ = false;
  if (!level) {
    ++framing_errors_;
    return std::nullopt;
  }
  return static_cast<std::uint8_t>(bits_);
}

bool UartLine::transmit() {
  if (bits_left_ == 0) {
    if (waiting_.empty()) return true;
    out_ = 0x200U | std::uint32_t{waiting_.front()} << 1;
    waiting_.pop_front();
    bits_left_ = 10;
    bit_time_ += bit_ticks_;
  }
  const bool level = (out_ & 1) != 0;
  bit_time_ -= 1.0;
  if (bit_time_ < 0.0) {
    out_ >>= 1;
    --bits_left_;
    bit_time_ = bits_left_ == 0 ? 0.0 : bit_time_ + bit_ticks_;
  }
  return level;
}

}  // namespace pharos::rtl
