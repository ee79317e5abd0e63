// SPDX-License-Identifier: Apache-2.0
#include "firmware/board/rv32/trap.hpp"

#include "firmware/board/rv32/processor.hpp"

namespace pharos::board {
namespace {

constexpr std::uint32_t kMachineTimer = 0x80000007;  // mcause

}  // namespace

/// Target of mtvec (start.S): the compiler saves the registers that the handler uses.
extern "C" [[gnu::interrupt("machine"), gnu::aligned(4)]] void pharos_trap() {
  Fault fault;
  asm volatile(PHAROS_CSR("csrr %0, mcause") : "=r"(fault.cause));
  if (fault.cause == kMachineTimer) {
    on_timer_interrupt();
    return;
  }
  asm volatile(PHAROS_CSR("csrr %0, mepc") : "=r"(fault.address));
  asm volatile(PHAROS_CSR("csrr %0, mtval") : "=r"(fault.value));
  on_fault(fault);
}

}  // namespace pharos::board
