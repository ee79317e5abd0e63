// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

namespace pharos::rtl {

/// Pins of the sequencer (firmware/rtl/up5k/ts4231_start.v), a bit per receiver.
struct StartOutputs {
  std::uint32_t e_driven = 0;
  std::uint32_t d_driven = 0;
  bool e_out = false;
  bool d_out = false;
  std::uint32_t ready = 0;
};

class StartDevice {
 public:
  virtual ~StartDevice() = default;
  /// One rising edge of its clock with these levels of the pins before it; outputs after it.
  virtual StartOutputs tick(std::uint32_t e_levels, std::uint32_t d_levels, bool reset) = 0;
};

std::unique_ptr<StartDevice> make_start_device();

}  // namespace pharos::rtl
