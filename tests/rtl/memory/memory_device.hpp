// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "rtl/chip/sdram_model.hpp"

namespace pharos::rtl {

/// The core's two buses to the memory outside the chip. Addresses are of words.
struct MemoryInputs {
  bool power_on_reset = false;
  bool reset = false;
  bool fetches = false;
  std::uint32_t fetch_address = 0;
  std::uint32_t next_fetch_address = 0;
  bool jumps = false;
  bool reads = false;
  std::uint32_t bytes = 0;  // written, a bit each
  std::uint32_t address = 0;
  std::uint32_t stored = 0;
  std::uint16_t sdram_data = 0;
};

struct MemoryOutputs {
  bool fetch_waits = false;
  std::uint32_t fetched = 0;  // of the tick before
  bool data_waits = false;
  std::uint32_t loaded = 0;  // of the tick before
  SdramPins sdram;
};

/// firmware/rtl/soc/soc_cache.v, Verilated.
class MemoryDevice {
 public:
  virtual ~MemoryDevice() = default;
  /// Outputs with these inputs, before the clock's edge.
  virtual MemoryOutputs show(const MemoryInputs& inputs) = 0;
  /// The edge, with the inputs that were shown.
  virtual void tick() = 0;
};

std::unique_ptr<MemoryDevice> make_memory_device();

}  // namespace pharos::rtl
