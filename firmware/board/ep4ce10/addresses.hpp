// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::board {

// Addresses of the devices of the EP4CE10 system: to be set in the bus fabric (Platform Designer) as given here.
// Memory: memory_*.ld.

inline constexpr std::uintptr_t kUart = 0x10000000;  // Intel 16550-compatible UART, FIFOs of 128 bytes
/// 50 MHz gives no 460,800 baud (3.1 % off): the UART runs on 50 MHz x 32 / 31 of the PLL, behind a clock-crossing
/// bridge: 460,829 baud.
inline constexpr std::uint16_t kUartDivisor = 7;
inline constexpr std::uintptr_t kCapture = 0x10001000;  // pharos_capture, PHAROS_CAPTURE_* of rtl/capture_registers.h
/// Interval Timer core as a watchdog: 1 s, counts down from start, system reset on timeout.
inline constexpr std::uintptr_t kWatchdog = 0x10003000;
inline constexpr std::uintptr_t kMachineTimer = 0x10004000;  // mtime at 50 MHz, then mtimecmp (Nios V/m's own order)
inline constexpr std::uintptr_t kMachineTimerCompare = 0x10004008;
inline constexpr std::uintptr_t kSpi = 0x10002000;  // Intel SPI core, 8 bits, master, to the configuration flash

}  // namespace pharos::board
