// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/board/chip/addresses.hpp"
#include "firmware/board/rv32/loader_memory.hpp"
#include "firmware/board/rv32/mmio.hpp"
#include "firmware/board/spi_nor_flash.hpp"
#include "firmware/boot/verifier.hpp"
#include "firmware/rtl/capture_registers.h"
#include PHAROS_CHIP_CONSTANTS

namespace pharos::board {

/// The chip's SPI master (firmware/rtl/soc/soc_spi.v).
class ChipSpi {
 public:
  static void select() { mmio32(kControl) = kForceSelect; }
  static void deselect() {
    while ((mmio32(kStatus) & kTransmitted) == 0) {
    }
    mmio32(kControl) = 0;
  }
  static std::uint8_t exchange(std::uint8_t byte) {
    mmio32(kTransmit) = byte;
    while ((mmio32(kStatus) & kReceived) == 0) {
    }
    return static_cast<std::uint8_t>(mmio32(kReceive));
  }

 private:
  static constexpr std::uintptr_t kReceive = kSpi;
  static constexpr std::uintptr_t kTransmit = kSpi + 4;
  static constexpr std::uintptr_t kStatus = kSpi + 8;
  static constexpr std::uintptr_t kControl = kSpi + 12;
  static constexpr std::uint32_t kTransmitted = 0x20;
  static constexpr std::uint32_t kReceived = 0x80;
  static constexpr std::uint32_t kForceSelect = 0x400;
};

/// The interface for the loader (boot/boot_board.hpp) of a board whose constants.hpp is PHAROS_CHIP_CONSTANTS. Runs on
/// the simulated chip; has not run on a board.
class LoaderBoard : public LoaderMemory {
 public:
  static constexpr const std::array<char, 24>& kName = kNameOfBoard;
  using Flash = SpiNorFlash<ChipSpi>;
  static constexpr std::uint32_t kSlotBytes = kSlotSectors * Flash::kSectorBytes;

  static void prepare() {
    mmio32(kUartLineControl) = kEightBits | kDivisorLatch;
    mmio32(kUart) = kUartDivisor;
    mmio32(kUart + 4) = kUartDivisor >> 8;
    mmio32(kUartLineControl) = kEightBits;
    mmio32(kUart + 8) = 1;  // FIFOs on
  }
  static std::uint32_t slot_offset(std::size_t slot) { return kFirstSlot + slot * kSlotBytes; }
  static Flash flash() { return {}; }
  static constexpr std::uint32_t kFloorOffset = kFloorSector;
  /// The jumper connects general pin 7 to ground; the chip's own pull-up holds it high otherwise.
  static bool development() { return (mmio32(kPins + 4) & 0x80) == 0; }
  static boot::Verdict verify(std::span<const std::uint8_t> message, const std::uint8_t* signature) {
    return boot::verify_in_memory<Flash>(kVerifierSector, boot::kVerifierSha256, boot::kVerifierBytes, message,
                                         signature);
  }

  static int receive() { return (mmio32(kUartLineStatus) & 0x01) != 0 ? static_cast<int>(mmio32(kUart) & 0xFF) : -1; }
  static bool transmit(std::uint8_t byte) {
    if ((mmio32(kUartLineStatus) & 0x20) == 0) return false;
    mmio32(kUart) = byte;
    return true;
  }
  static std::uint32_t ticks() { return mmio32(kCapture + PHAROS_CAPTURE_TIME_LOW_OFFSET); }
  /// The loader's memory is a ROM, so a jump to its first instruction is equivalent to a reset. With the watchdog
  /// running: an image that hangs before it could start it is reset too.
  [[noreturn]] static void start(std::uint32_t entry) {
    mmio32(kWatchdog + 4) = 4;
    LoaderMemory::start(entry);
  }
  [[noreturn]] static void restart() { LoaderMemory::start(reinterpret_cast<std::uintptr_t>(__loader)); }

 private:
  static constexpr std::uintptr_t kUartLineControl = kUart + 12;
  static constexpr std::uintptr_t kUartLineStatus = kUart + 20;
  static constexpr std::uint32_t kEightBits = 0x03;
  static constexpr std::uint32_t kDivisorLatch = 0x80;
};

}  // namespace pharos::board
