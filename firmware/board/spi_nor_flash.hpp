// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pharos::board {

/// An SPI master with one chip on it, mode 0 or 3, most significant bit first.
template <class B>
concept SpiBus = requires(std::uint8_t byte) {
  B::select();
  B::deselect();
  { B::exchange(byte) } -> std::same_as<std::uint8_t>;
};

/// Serial NOR flash with the commands common to all of them, 3-byte addresses, pages of 256 bytes and sectors of 64
/// KiB: Intel's EPCS16 and EPCS64, M25P16, W25Q16 and similar.
template <SpiBus Bus>
class SpiNorFlash {
 public:
  static constexpr std::uint32_t kSectorBytes = 64 * 1024;

  static void read(std::uint32_t offset, std::span<std::uint8_t> out) {
    begin(kRead, offset);
    for (std::uint8_t& byte : out) byte = Bus::exchange(0);
    Bus::deselect();
  }

  template <class Idle>
  static bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes, Idle&& idle) {
    if (!enable_writing()) return false;
    begin(kProgram, offset);
    for (const std::uint8_t byte : bytes) {
      Bus::exchange(byte);
      idle();
    }
    return finish(idle);
  }

  template <class Idle>
  static bool erase_sector(std::uint32_t offset, Idle&& idle) {
    if (!enable_writing()) return false;
    begin(kEraseSector, offset);
    return finish(idle);
  }

 private:
  static constexpr std::uint8_t kProgram = 0x02;
  static constexpr std::uint8_t kRead = 0x03;
  static constexpr std::uint8_t kReadStatus = 0x05;
  static constexpr std::uint8_t kWriteEnable = 0x06;
  static constexpr std::uint8_t kEraseSector = 0xD8;
  static constexpr std::uint8_t kBusy = 0x01;
  static constexpr std::uint8_t kWritable = 0x02;
  /// Status reads until the chip times out. The slowest sector takes 3 s; a read takes at least a microsecond.
  static constexpr std::uint32_t kMaxPolls = 16'000'000;

  static void begin(std::uint8_t command, std::uint32_t offset) {
    Bus::select();
    Bus::exchange(command);
    for (int shift = 16; shift >= 0; shift -= 8) Bus::exchange(static_cast<std::uint8_t>(offset >> shift));
  }
  static std::uint8_t status() {
    Bus::select();
    Bus::exchange(kReadStatus);
    const std::uint8_t status = Bus::exchange(0);
    Bus::deselect();
    return status;
  }
  /// False where no chip responds: an open line reads all ones or all zeros.
  static bool enable_writing() {
    Bus::select();
    Bus::exchange(kWriteEnable);
    Bus::deselect();
    return (status() & (kWritable | kBusy)) == kWritable;
  }
  /// The command takes effect when the chip is deselected.
  template <class Idle>
  static bool finish(Idle& idle) {
    Bus::deselect();
    for (std::uint32_t polls = 0; polls < kMaxPolls; ++polls) {
      idle();
      if ((status() & kBusy) == 0) return true;
    }
    return false;
  }
};

}  // namespace pharos::board
