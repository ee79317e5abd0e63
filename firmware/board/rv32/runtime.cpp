// SPDX-License-Identifier: Apache-2.0
// The few functions that compiler and C library require of a platform. What the core must not use stays undefined.
#include "firmware/board/rv32/trap.hpp"

extern "C" {
[[noreturn]] void abort() { pharos::board::on_fault({}); }
[[noreturn]] void __cxa_pure_virtual() { pharos::board::on_fault({}); }
void* __dso_handle = nullptr;
}
