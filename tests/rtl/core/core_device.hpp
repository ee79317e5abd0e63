// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "rtl/core/processor_model.hpp"

namespace pharos::rtl {

/// Inputs of pharos_core in one tick, except dbus_fault, which depends on the address.
struct CoreInputs {
  bool reset = false;
  bool fetch_waits = false;
  std::uint32_t fetched = 0;
  bool fetch_fault = false;
  bool data_waits = false;
  std::uint32_t loaded = 0;
  bool timer_interrupt = false;
};

/// Its outputs in that tick, before the clock's edge.
struct CoreOutputs {
  bool fetches = false;
  std::uint32_t fetch_address = 0;
  bool reads = false;
  bool writes = false;
  std::uint32_t data_address = 0;  // of the word
  std::uint8_t bytes = 0;
  std::uint32_t stored = 0;
  bool ends = false;  // an instruction
  std::uint32_t address = 0;
  bool trapped = false;
  bool interrupted = false;

  bool operator==(const CoreOutputs&) const = default;
};

/// The Verilated core, one clock tick at a time: show() the inputs, then tick().
class CoreDevice {
 public:
  virtual ~CoreDevice() = default;
  /// Outputs with these inputs; `refuses(address)` is the data bus's fault for a word address.
  virtual CoreOutputs show(const CoreInputs& inputs, bool (*refuses)(std::uint32_t)) = 0;
  virtual void tick() = 0;
  /// Registers, control registers and instret; pc is not among it. Register 0 is what the block RAM holds.
  virtual ProcessorState state() const = 0;
  /// Whether the two copies of the registers hold the same.
  virtual bool copies_agree() const = 0;
  /// Sets a register as its block RAM holds it.
  virtual void set_register(unsigned number, std::uint32_t value) = 0;
  virtual void set_counters(std::uint64_t cycle, std::uint64_t instret) = 0;
};

std::unique_ptr<CoreDevice> make_core_device();

}  // namespace pharos::rtl
