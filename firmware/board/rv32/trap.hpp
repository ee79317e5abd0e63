// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::board {

/// Cause of a fault, in the terms of the privileged specification.
struct Fault {
  std::uint32_t cause = 0;    // mcause
  std::uint32_t address = 0;  // mepc: the instruction
  std::uint32_t value = 0;    // mtval: the address or instruction that was refused
};

/// Called on every exception and on unexpected interrupts. Selected at link time: fault_exit.cpp (test programs: print
/// it and end) or fault_restart.cpp (images: keep the cause and restart).
[[noreturn]] void on_fault(const Fault& fault);

/// Called on the machine timer's interrupt; each board has a default that counts as a fault.
void on_timer_interrupt();

}  // namespace pharos::board
