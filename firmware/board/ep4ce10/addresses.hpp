// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/board/chip/addresses.hpp"

namespace pharos::board {

// The chip of firmware/rtl/soc on an EP4CE10, 50 MHz. Memory: memory_*.ld.

/// The UART's divisor counts 1/16 ticks a bit: 460,829 baud of 460,800.
inline constexpr std::uint16_t kUartDivisor = 1736;
inline constexpr std::uintptr_t kMachineTimer = kTimer;  // mtime at 50 MHz, then mtimecmp
inline constexpr std::uintptr_t kMachineTimerCompare = kTimer + 8;

}  // namespace pharos::board
