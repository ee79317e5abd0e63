// SPDX-License-Identifier: Apache-2.0
// For images: a fault is kept over the reset and reported in the next Hello.
#include "firmware/board/rv32/restart.hpp"
#include "firmware/board/rv32/trap.hpp"

extern "C" [[noreturn]] void pharos_exit(int) { pharos::board::on_fault({}); }

namespace pharos::board {

void on_fault(const Fault& fault) {
  volatile boot::Retained& kept = retained();
  kept.fault_cause = fault.cause;
  kept.fault_address = fault.address;
  kept.fault_value = fault.value;
  boot::announce_reset(kept, wire::ResetCause::kFault);
  reset_machine();
}

}  // namespace pharos::board
