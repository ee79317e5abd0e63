// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/board/rv32/mmio.hpp"

namespace pharos::board {

/// The second bank of QEMU's parallel NOR flash (CFI, Intel command set): two 16-bit chips side by side, one word at a
/// time. The first bank would change where the machine starts, so it stays empty.
class CfiFlash {
 public:
  static constexpr std::uint32_t kSectorBytes = 256 * 1024;

  static void read(std::uint32_t offset, std::span<std::uint8_t> out) {
    std::memcpy(out.data(), reinterpret_cast<const void*>(kBase + offset), out.size());
  }

  template <class Idle>
  static bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes, Idle&& idle) {
    bool good = true;
    for (std::size_t at = 0; at < bytes.size() && good; at += 4) {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes.data() + at, sizeof word);
      good = command(offset + at, kProgram, word, idle);
    }
    mmio32(kBase) = kReadArray;
    return good;
  }

  template <class Idle>
  static bool erase_sector(std::uint32_t offset, Idle&& idle) {
    const bool good = command(offset, kErase, kEraseConfirm, idle);
    mmio32(kBase) = kReadArray;
    return good;
  }

 private:
  static constexpr std::uintptr_t kBase = 0x22000000;
  // The same for both chips.
  static constexpr std::uint32_t kProgram = 0x00400040;
  static constexpr std::uint32_t kErase = 0x00200020;
  static constexpr std::uint32_t kEraseConfirm = 0x00D000D0;
  static constexpr std::uint32_t kClearStatus = 0x00500050;
  static constexpr std::uint32_t kReadArray = 0x00FF00FF;
  static constexpr std::uint32_t kReady = 0x00800080;
  static constexpr std::uint32_t kFailed = 0x007E007E;  // all but ready and reserved

  template <class Idle>
  static bool command(std::uintptr_t offset, std::uint32_t first, std::uint32_t second, Idle&& idle) {
    mmio32(kBase + offset) = kClearStatus;
    mmio32(kBase + offset) = first;
    mmio32(kBase + offset) = second;
    std::uint32_t status = 0;
    do {
      idle();
      status = mmio32(kBase + offset);
    } while ((status & kReady) != kReady);
    return (status & kFailed) == 0;
  }
};

}  // namespace pharos::board
