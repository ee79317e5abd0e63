// SPDX-License-Identifier: Apache-2.0
// Made by firmware/rtl/soc/addresses.py of addresses.toml.
#pragma once

#include <cstdint>

namespace pharos::board {

/// UART, registers of a 16550 a word apart, FIFOs of 128 bytes; the divisor counts 1/16 clock ticks a bit.
inline constexpr std::uintptr_t kUart = 0x10000000;
/// pharos_capture, registers of capture_registers.h.
inline constexpr std::uintptr_t kCapture = 0x10001000;
/// SPI master to the configuration flash: 0 receive, 4 transmit, 8 status, 12 control.
inline constexpr std::uintptr_t kSpi = 0x10002000;
/// 4 control: bit 2 starts it; 8: a write restarts its second; reset of the chip when it ends.
inline constexpr std::uintptr_t kWatchdog = 0x10003000;
/// mtime in ticks of the core's clock, at 8 mtimecmp.
inline constexpr std::uintptr_t kTimer = 0x10004000;
/// 0 LEDs; 4 levels of general pins; 8 their outputs; 12 which of them are driven.
inline constexpr std::uintptr_t kPins = 0x10005000;

}  // namespace pharos::board
