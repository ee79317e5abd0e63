// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

namespace pharos::rtl {

/// The other end of the chip's serial line: 8N1 at 460,800 baud.
class UartLine {
 public:
  explicit UartLine(double tick_hz) : bit_ticks_(tick_hz / 460'800) {}

  /// One tick: level of the chip's transmitter; a byte when its stop bit was seen.
  std::optional<std::uint8_t> receive(bool level);
  /// One tick: the level that the chip's receiver sees.
  bool transmit();
  void send(std::span<const std::uint8_t> bytes) { waiting_.insert(waiting_.end(), bytes.begin(), bytes.end()); }
  bool sent() const { return waiting_.empty() && bits_left_ == 0; }
  /// Bytes without a stop bit.
  std::uint32_t framing_errors() const { return framing_errors_; }

 private:
  double bit_ticks_;

  // From the chip.
  bool last_ = true;
  bool receiving_ = false;
  double next_sample_ = 0.0;
  double now_ = 0.0;  // ticks since the start bit
  unsigned sampled_ = 0;
  std::uint32_t bits_ = 0;
  std::uint32_t framing_errors_ = 0;
  // To the chip.
  std::deque<std::uint8_t> waiting_;
  std::uint32_t out_ = 0;
  unsigned bits_left_ = 0;
  double bit_time_ = 0.0;
};

}  // namespace pharos::rtl
