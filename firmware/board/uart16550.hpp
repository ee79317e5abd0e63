// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/board/rv32/mmio.hpp"

namespace pharos::board {

/// A 16550-compatible UART with FIFOs, 8N1: QEMU's (a byte a register) and the chip's own (a word a register;
/// firmware/rtl/soc/soc_uart.v). The baud rate is set by the program that starts first.
class Uart16550 {
 public:
  constexpr Uart16550(std::uintptr_t base, std::uintptr_t register_bytes, std::size_t transmit_fifo)
      : base_(base), stride_(register_bytes), fifo_(transmit_fifo) {}

  /// `divisor`: the UART's; 0: leave it as it is.
  void start(std::uint16_t divisor) {
    put(kLineControl, kEightBits | kDivisorLatch);
    if (divisor != 0) {
      put(kData, static_cast<std::uint8_t>(divisor));
      put(kInterruptEnable, static_cast<std::uint8_t>(divisor >> 8));
    }
    put(kLineControl, kEightBits);
    put(kInterruptEnable, 0);
    put(kFifoControl, kFifoEnable);
  }
  /// Fills the FIFO once it is empty; else accepts nothing.
  std::size_t write(std::span<const std::uint8_t> bytes) {
    if ((line_status() & kTransmitEmpty) == 0) return 0;
    const std::size_t count = bytes.size() < fifo_ ? bytes.size() : fifo_;
    volatile std::uint8_t& data = mmio8(at(kData));  // not once a byte: a byte written may be any object of this one's
    for (const std::uint8_t byte : bytes.first(count)) data = byte;
    return count;
  }
  bool idle() { return (line_status() & kTransmitterIdle) != 0; }
  std::optional<std::uint8_t> read() {
    if ((line_status() & kDataReady) == 0) return std::nullopt;
    return mmio8(at(kData));
  }
  /// Number of overruns and missing stop bits.
  std::uint32_t receive_errors() const { return errors_; }

 private:
  static constexpr std::uintptr_t kData = 0;  // and the divisor's low byte
  static constexpr std::uintptr_t kInterruptEnable = 1;
  static constexpr std::uintptr_t kFifoControl = 2;
  static constexpr std::uintptr_t kLineControl = 3;
  static constexpr std::uintptr_t kLineStatus = 5;
  static constexpr std::uint8_t kFifoEnable = 0x01;
  static constexpr std::uint8_t kEightBits = 0x03;
  static constexpr std::uint8_t kDivisorLatch = 0x80;
  static constexpr std::uint8_t kDataReady = 0x01;
  static constexpr std::uint8_t kOverrun = 0x02;
  static constexpr std::uint8_t kFraming = 0x08;
  static constexpr std::uint8_t kTransmitEmpty = 0x20;
  static constexpr std::uint8_t kTransmitterIdle = 0x40;

  std::uintptr_t at(std::uintptr_t index) const { return base_ + index * stride_; }
  void put(std::uintptr_t index, std::uint8_t value) { mmio8(at(index)) = value; }
  // Reading clears the error bits.
  std::uint8_t line_status() {
    const std::uint8_t status = mmio8(at(kLineStatus));
    if ((status & (kOverrun | kFraming)) != 0) ++errors_;
    return status;
  }

  std::uintptr_t base_;
  std::uintptr_t stride_;
  std::size_t fifo_;
  std::uint32_t errors_ = 0;
};

}  // namespace pharos::board
