// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::board {

// The chip of firmware/rtl/up5k on an iCE40UP5K. Memory: memory_*.ld.

alignas(4) inline constexpr std::array<char, 24> kNameOfBoard{"up5k"};
inline constexpr std::uint32_t kClockHz = 16'000'000;
/// The UART's divisor counts 1/16 ticks a bit: 460,432 baud of 460,800.
inline constexpr std::uint16_t kUartDivisor = 556;

// A flash of 1 MiB: the slots lie after the FPGA's configuration (104,090 bytes, at 0 or 0x20000).
inline constexpr std::uint32_t kFirstSlot = 0x40000;
inline constexpr std::uint32_t kSlotSectors = 2;
inline constexpr std::uint32_t kFloorSector = 0xA0000;
inline constexpr std::uint32_t kVerifierSector = 0xF0000;

}  // namespace pharos::board
