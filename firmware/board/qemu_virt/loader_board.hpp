// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/board/qemu_virt/cfi_flash.hpp"
#include "firmware/board/rv32/loader_memory.hpp"
#include "firmware/board/rv32/mmio.hpp"
#include "firmware/boot/retained.hpp"
#include "firmware/boot/verifier.hpp"

namespace pharos::board {

/// The interface of `qemu-system-riscv32 -M virt` for the loader (boot/boot_board.hpp). All is here and inline: 4 KiB.
class LoaderBoard : public LoaderMemory {
 public:
  using Flash = CfiFlash;
  alignas(4) static constexpr std::array<char, 24> kName{"qemu_virt"};
  static constexpr std::uint32_t kSlotBytes = CfiFlash::kSectorBytes;

  static void prepare() {
    mmio8(kUart + 2) = 1;                           // receive up to 16 bytes ahead
    (void)static_cast<std::uint8_t>(mmio8(kUart));  // QEMU drops earlier bytes, and receives none until read once
  }

  static std::uint32_t slot_offset(std::size_t slot) { return slot * kSlotBytes; }
  static Flash flash() { return {}; }
  static constexpr std::uint32_t kFloorOffset = 3 * kSlotBytes;
  static constexpr std::uint32_t kVerifierOffset = 4 * kSlotBytes;
  /// The jumper: a word that the machine's command line sets (`-device loader,addr=0x8070fffc,data=1,data-len=4`).
  static bool development() { return mmio32(0x8070FFFC) == 1; }
  static boot::Verdict verify(std::span<const std::uint8_t> message, const std::uint8_t* signature) {
    return boot::verify_in_memory<Flash>(kVerifierOffset, boot::kVerifierSha256, boot::kVerifierBytes, message,
                                         signature);
  }

  static int receive() { return (mmio8(kUartLineStatus) & 0x01) != 0 ? mmio8(kUart) : -1; }
  static bool transmit(std::uint8_t byte) {
    if ((mmio8(kUartLineStatus) & 0x20) == 0) return false;
    mmio8(kUart) = byte;
    return true;
  }
  /// The CLINT's 10 MHz in ticks of 20 ns.
  static std::uint32_t ticks() { return mmio32(0x200BFF8) * 5; }
  [[noreturn]] static void restart() {
    mmio32(0x100000) = 0x7777;
    for (;;) asm volatile("wfi");
  }

 private:
  static constexpr std::uintptr_t kUart = 0x10000000;
  static constexpr std::uintptr_t kUartLineStatus = kUart + 5;
};

}  // namespace pharos::board
