// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace pharos::board {

// The devices of `qemu-system-riscv32 -M virt` that Pharos uses.

/// Ends the emulator with this exit code (sifive_test device); 0 is success.
[[noreturn]] void exit_emulator(int code);
/// Resets the machine: memory outside the loaded image is kept.
[[noreturn]] void reset_machine();

/// Time since start of the machine in ticks of 20 ns, from the 10 MHz CLINT: steps of 5. Under `-icount shift=0` an
/// instruction takes 1 ns.
std::int64_t machine_ticks();
/// Sets the time of the next machine timer interrupt.
void set_timer(std::int64_t machine_ticks);

/// One byte to the first UART (16550), blocking until it is accepted.
void console_put(char byte);
/// Text for test programs; a newline is sent as it is.
void console_write(std::string_view text);
void console_write_decimal(std::int64_t number);
void console_write_hex(std::uint32_t number);

}  // namespace pharos::board
