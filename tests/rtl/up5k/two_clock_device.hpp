// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "rtl/capture_device.hpp"

namespace pharos::rtl {

/// The Verilated capture block on two clocks (firmware/rtl/up5k/up5k_capture.v), each of whose edges comes when the
/// caller wants it.
class TwoClockDevice {
 public:
  virtual ~TwoClockDevice() = default;
  virtual void rise_capture_clock(std::uint32_t pins) = 0;
  /// With this request on the bus before it.
  virtual void rise_clock(const BusRequest& request, bool reset) = 0;
  /// Whether such a request would wait in this tick.
  virtual bool waits(const BusRequest& request) = 0;
  virtual std::uint32_t read_data() const = 0;
  /// The counter.
  virtual std::uint64_t ticks() const = 0;
  virtual void set_ticks(std::uint64_t ticks) = 0;
};

std::unique_ptr<TwoClockDevice> make_two_clock_device();

}  // namespace pharos::rtl
