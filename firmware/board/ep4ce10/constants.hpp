// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::board {

// The chip of firmware/rtl/soc on an EP4CE10. Memory: memory_*.ld.

alignas(4) inline constexpr std::array<char, 24> kNameOfBoard{"ep4ce10"};
inline constexpr std::uint32_t kClockHz = 50'000'000;
/// The UART's divisor counts 1/16 ticks a bit: 460,829 baud of 460,800.
inline constexpr std::uint16_t kUartDivisor = 1736;

// The flash, an EPCS16: the slots lie after the FPGA's configuration (368,011 bytes).
inline constexpr std::uint32_t kFirstSlot = 0x100000;
inline constexpr std::uint32_t kSlotSectors = 4;
inline constexpr std::uint32_t kFloorSector = 0x1C0000;
/// The last sector: what the flash's block protection covers first.
inline constexpr std::uint32_t kVerifierSector = 0x1F0000;

}  // namespace pharos::board
