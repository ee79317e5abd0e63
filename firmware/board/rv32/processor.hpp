// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::board {

// Features of RV32IM with Zicsr beyond C++. The compiler's -march is plain rv32im (the C library has no variant with
// zicsr in its name), so each instruction enables it.
#define PHAROS_CSR(instruction) ".option push\n.option arch, +zicsr\n" instruction "\n.option pop"

/// Instructions executed since start, this call's own among them. Under `qemu-system-riscv32 -icount shift=0` the same
/// program with the same input always counts the same.
inline std::uint64_t instructions_retired() {
  std::uint32_t high = 0;
  std::uint32_t low = 0;
  std::uint32_t high_again = 0;
  do {
    asm volatile(PHAROS_CSR("rdinstreth %0") : "=r"(high));
    asm volatile(PHAROS_CSR("rdinstret %0") : "=r"(low));
    asm volatile(PHAROS_CSR("rdinstreth %0") : "=r"(high_again));
  } while (high != high_again);
  return (std::uint64_t{high} << 32) | low;
}

/// The lower half of it, in one instruction: for intervals of less than 2^32.
[[gnu::always_inline]] inline std::uint32_t instructions_retired_low() {
  std::uint32_t low = 0;
  asm volatile(PHAROS_CSR("rdinstret %0") : "=r"(low)::"memory");
  return low;
}

/// Machine interrupts as a whole: mstatus.MIE.
inline void enable_interrupts() { asm volatile(PHAROS_CSR("csrsi mstatus, 8")::: "memory"); }
inline void disable_interrupts() { asm volatile(PHAROS_CSR("csrci mstatus, 8")::: "memory"); }

/// The machine timer's interrupt: mie.MTIE. With it enabled here but interrupts off as a whole, it still ends
/// wait_for_interrupt().
inline void enable_timer_interrupt() {
  const std::uint32_t timer = 1U << 7;
  asm volatile(PHAROS_CSR("csrs mie, %0")::"r"(timer) : "memory");
}
inline void wait_for_interrupt() { asm volatile("wfi" ::: "memory"); }

}  // namespace pharos::board
