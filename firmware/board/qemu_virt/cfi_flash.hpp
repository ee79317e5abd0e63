// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "firmware/board/rv32/mmio.hpp"

namespace pharos::board {

/// The second bank of QEMU's parallel NOR flash (CFI, Intel command set): two 16-bit chips side by side, written a page
/// at a time through their write buffers. The first bank would change where the machine starts, so it stays empty.
class CfiFlash {
 public:
  static constexpr std::uint32_t kSectorBytes = 256 * 1024;

  static void read(std::uint32_t offset, std::span<std::uint8_t> out) {
    std::memcpy(out.data(), reinterpret_cast<const void*>(kBase + offset), out.size());
  }

  template <class Idle>
  static bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes, Idle&& idle) {
    const std::uint32_t words = static_cast<std::uint32_t>(bytes.size() / 4);
    begin(offset, kWriteBuffer);
    mmio32(kBase + offset) = (words - 1) * kBothChips;
    for (std::uint32_t i = 0; i < words; ++i) {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes.data() + 4 * i, sizeof word);
      mmio32(kBase + offset + 4 * i) = word;
    }
    return finish(offset, idle);
  }

  template <class Idle>
  static bool erase_sector(std::uint32_t offset, Idle&& idle) {
    begin(offset, kErase);
    return finish(offset, idle);
  }

 private:
  static constexpr std::uintptr_t kBase = 0x22000000;
  static constexpr std::uint32_t kBothChips = 0x00010001;
  static constexpr std::uint32_t kWriteBuffer = 0xE8 * kBothChips;
  static constexpr std::uint32_t kErase = 0x20 * kBothChips;
  static constexpr std::uint32_t kConfirm = 0xD0 * kBothChips;
  static constexpr std::uint32_t kClearStatus = 0x50 * kBothChips;
  static constexpr std::uint32_t kReadArray = 0xFF * kBothChips;
  static constexpr std::uint32_t kReady = 0x80 * kBothChips;
  static constexpr std::uint32_t kFailed = 0x7E * kBothChips;  // all but ready and reserved

  static void begin(std::uint32_t offset, std::uint32_t command) {
    mmio32(kBase + offset) = kClearStatus;
    mmio32(kBase + offset) = command;
  }
  template <class Idle>
  static bool finish(std::uint32_t offset, Idle&& idle) {
    mmio32(kBase + offset) = kConfirm;
    std::uint32_t status = 0;
    do {
      idle();
      status = mmio32(kBase + offset);
    } while ((status & kReady) != kReady);
    mmio32(kBase) = kReadArray;
    return (status & kFailed) == 0;
  }
};

}  // namespace pharos::board
