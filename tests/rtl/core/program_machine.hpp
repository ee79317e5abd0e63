// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace pharos::rtl {

/// What the program told: a byte to its UART, or the word with which it ends the machine.
struct ProgramEvent {
  bool ended = false;
  std::uint32_t word = 0;
};

/// The Verilated program_machine.v. Memory begins at 0x80000000, where the processor starts.
class ProgramMachine {
 public:
  virtual ~ProgramMachine() = default;
  virtual std::span<std::uint32_t> memory() = 0;
  virtual void reset() = 0;
  /// Runs to the next event; false if there was none until `cycles`, counted since the reset.
  virtual bool run(std::uint64_t cycles, ProgramEvent& event) = 0;
  virtual std::uint64_t cycles() const = 0;
  virtual std::uint64_t instructions() const = 0;
};

std::unique_ptr<ProgramMachine> make_program_machine();

}  // namespace pharos::rtl
