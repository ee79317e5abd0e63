// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace pharos::rtl {

/// Memory and devices as a processor sees them. Word addresses are multiples of 4; `bytes` is a mask of the word's four
/// bytes, and `value` has each of them in its place.
class ModelBus {
 public:
  virtual ~ModelBus() = default;
  /// The word at the address; nothing where the bus refuses it.
  virtual std::optional<std::uint32_t> fetch(std::uint32_t word_address) = 0;
  virtual std::optional<std::uint32_t> load(std::uint32_t word_address, std::uint8_t bytes) = 0;
  /// False where the bus refuses it.
  virtual bool store(std::uint32_t word_address, std::uint8_t bytes, std::uint32_t value) = 0;
};

/// Architectural state.
struct ProcessorState {
  std::uint32_t pc = 0;
  std::array<std::uint32_t, 32> x{};
  bool mie = false;   // mstatus.MIE
  bool mpie = false;  // mstatus.MPIE
  bool mtie = false;  // mie.MTIE
  std::uint32_t mtvec = 0;
  std::uint32_t mepc = 0;
  std::uint32_t mcause = 0;
  std::uint32_t mtval = 0;
  std::uint64_t instret = 0;

  bool operator==(const ProcessorState&) const = default;
};

/// What the world outside determines for one instruction.
struct ModelInputs {
  std::uint64_t cycle = 0;       // value of the cycle counter
  bool timer_interrupt = false;  // level of the line
};

enum class StepResult : std::uint8_t { kRetired, kTrapped };

/// Reference of an RV32IM processor with Zicsr and Zifencei in machine mode, from the RISC-V manuals (unprivileged
/// 20191213, privileged 20211203): one instruction a call, no pipeline. Shares nothing with the Verilog.
class ProcessorModel {
 public:
  ProcessorModel(ModelBus& bus, std::uint32_t reset_address) : bus_(bus) { state_.pc = reset_address; }

  const ProcessorState& state() const { return state_; }
  ProcessorState& state() { return state_; }
  /// Executes the instruction at pc, or enters its trap.
  StepResult step(const ModelInputs& inputs);
  /// Enters the machine timer's interrupt in place of the instruction at pc.
  void interrupt();

 private:
  struct Instruction;

  StepResult trap(std::uint32_t cause, std::uint32_t value);
  StepResult illegal(std::uint32_t word) { return trap(2, word); }
  StepResult retire(std::uint32_t next_pc);
  StepResult write(unsigned rd, std::uint32_t value);
  StepResult jump(std::uint32_t target, unsigned rd);
  StepResult branch(const Instruction& in);
  StepResult load(const Instruction& in);
  StepResult store(const Instruction& in);
  std::optional<std::uint32_t> load_bytes(std::uint32_t address, unsigned size);
  bool store_bytes(std::uint32_t address, unsigned size, std::uint32_t value);
  StepResult arithmetic(const Instruction& in);
  StepResult system(const Instruction& in, const ModelInputs& inputs);
  std::optional<std::uint32_t> read_csr(std::uint32_t number, const ModelInputs& inputs) const;
  void write_csr(std::uint32_t number, std::uint32_t value);

  ModelBus& bus_;
  ProcessorState state_;
};

}  // namespace pharos::rtl
