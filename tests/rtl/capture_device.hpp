// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

namespace pharos::rtl {

/// Bus request to the capture block in one tick. Offsets are those of firmware/rtl/capture_registers.h.
struct BusRequest {
  enum class Kind : std::uint8_t { kNone, kRead, kWrite };
  Kind kind = Kind::kNone;
  std::uint8_t offset = 0;
  std::uint32_t data = 0;
};

/// The Verilated capture block, simulated one clock tick at a time.
class CaptureDevice {
 public:
  virtual ~CaptureDevice() = default;

  /// One rising edge of the clock, with these levels on the pins and this request on the bus before it.
  virtual void tick(std::uint32_t pins, const BusRequest& request) = 0;
  /// Four ticks of reset with these levels on the pins.
  virtual void reset(std::uint32_t pins) = 0;
  /// Read data of the bus, for a read request of the tick before.
  virtual std::uint32_t read_data() const = 0;
  virtual bool interrupt() const = 0;
  /// The tick counter, which the simulation may set.
  virtual std::uint64_t ticks() const = 0;
  virtual void set_ticks(std::uint64_t ticks) = 0;
};

/// Parameters of the linked variant of the block.
std::unique_ptr<CaptureDevice> make_capture_device();

}  // namespace pharos::rtl
