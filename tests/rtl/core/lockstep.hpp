// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rtl/core/core_device.hpp"
#include "rtl/core/instruction_stream.hpp"
#include "rtl/core/processor_model.hpp"

namespace pharos::rtl {

/// An access to the data bus that was taken or refused.
struct DataAccess {
  bool write = false;
  std::uint32_t address = 0;
  std::uint8_t bytes = 0;
  std::uint32_t value = 0;  // of a write: the bytes in `bytes`, zeros elsewhere
  bool operator==(const DataAccess&) const = default;
};

/// Instruction and data memories of a few KiB that repeat over the whole address space, except where the bus refuses.
class RepeatedMemory {
 public:
  static constexpr std::uint32_t kWords = 4096;
  static bool refuses_fetch(std::uint32_t address) { return address >> 29 == 5; }
  static bool refuses_data(std::uint32_t address) { return address >> 29 == 6; }

  std::uint32_t& code(std::uint32_t address) { return code_[address / 4 % kWords]; }
  std::uint32_t& data(std::uint32_t address) { return data_[address / 4 % kWords]; }
  void store(const DataAccess& access);

 private:
  std::array<std::uint32_t, kWords> code_{};
  std::array<std::uint32_t, kWords> data_{};
};

/// The Verilated core and the reference model in parallel. After each instruction all registers, control registers, the
/// instruction's address and its accesses to the data bus are compared; in every tick, the bus's rules are checked.
class Lockstep {
 public:
  explicit Lockstep(std::uint64_t seed);

  struct Options {
    std::uint32_t fetch_waits_of_8 = 2;
    std::uint32_t data_waits_of_8 = 2;
    bool interrupts = true;
  };
  /// A reset, with these registers; memories stay.
  void reset(const std::array<std::uint32_t, 32>& registers);
  /// Until so many instructions have ended. False when the two differ: difference() tells how.
  bool run(std::uint64_t instructions, const Options& options);
  bool run(std::uint64_t instructions) { return run(instructions, Options{}); }
  const std::string& difference() const { return difference_; }

  /// Random programs in random memories, each from a reset. An executed word is replaced by a new one: no program gets
  /// caught in a loop.
  bool run_random(std::uint64_t instructions);

  RepeatedMemory& memory() { return memory_; }
  ProcessorState& model_state() { return model_.state(); }
  void set_counters(std::uint64_t cycle, std::uint64_t instret);
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t interrupts() const { return interrupts_; }
  /// Instructions that ended so far, by kind; those trapped, by cause.
  const std::array<std::uint64_t, kInstructionKinds.size()>& ended() const { return ended_; }
  const std::array<std::uint64_t, 16>& trapped() const { return trapped_; }

 private:
  class Bus;

  void tick(const Options& options);
  void check_bus(const CoreOutputs& now);
  void take_accesses(const CoreOutputs& now);
  void end(const CoreOutputs& now);
  void compare(std::uint32_t address, std::uint32_t word);
  void renew_code(std::uint32_t address, bool retired);
  void differs(const std::string& what);

  static constexpr std::uint32_t kResetAddress = 0x80000000;

  InstructionStream stream_;
  RepeatedMemory memory_;        // the core's
  RepeatedMemory model_memory_;  // the model's data
  std::vector<DataAccess> core_accesses_;
  std::vector<DataAccess> model_accesses_;
  std::unique_ptr<CoreDevice> core_ = make_core_device();
  std::unique_ptr<ModelBus> bus_;
  ProcessorModel model_;
  CoreInputs inputs_;
  CoreOutputs before_;  // outputs of the tick before
  bool data_waited_ = false;
  bool always_pending_ = false;  // the interrupt line was high since the last instruction ended
  std::uint64_t cycle_ = 0;
  std::uint64_t ticks_ = 0;
  std::uint64_t instructions_ = 0;
  std::uint64_t interrupts_ = 0;
  bool renews_code_ = false;
  std::uint32_t ticks_without_end_ = 0;
  std::array<std::uint64_t, kInstructionKinds.size()> ended_{};
  std::array<std::uint64_t, 16> trapped_{};
  std::string difference_;
};

}  // namespace pharos::rtl
