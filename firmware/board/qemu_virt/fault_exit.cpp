// SPDX-License-Identifier: Apache-2.0
// For test programs: main's value is the emulator's exit code, and a fault is printed and ends it with 70.
#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/trap.hpp"

extern "C" [[noreturn]] void pharos_exit(int code) { pharos::board::exit_emulator(code); }

namespace pharos::board {

void on_fault(const Fault& fault) {
  constexpr int kInternalError = 70;  // EX_SOFTWARE
  console_write("\nfault: mcause 0x");
  console_write_hex(fault.cause);
  console_write(" mepc 0x");
  console_write_hex(fault.address);
  console_write(" mtval 0x");
  console_write_hex(fault.value);
  console_write("\n");
  exit_emulator(kInternalError);
}

[[gnu::weak]] void on_timer_interrupt() { on_fault({.cause = 0x80000007, .address = 0, .value = 0}); }

}  // namespace pharos::board
