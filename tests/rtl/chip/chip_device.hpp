// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "rtl/chip/sdram_model.hpp"

namespace pharos::rtl {

/// Pins into the chip.
struct ChipInputs {
  bool power_on_reset = false;
  std::uint32_t photodiodes = 0;
  bool uart_receive = true;
  bool spi_in = true;
  std::uint16_t sdram_data = 0;
};

/// Pins out of it, and for measurements: an instruction ended, or the core was in reset.
struct ChipOutputs {
  bool uart_transmit = true;
  bool spi_clock = false;
  bool spi_select_n = true;
  bool spi_out = false;
  bool instruction_ended = false;
  SdramPins sdram;               // resting where the chip has none
  bool external_fetch = false;   // an instruction was taken from the cache
  bool fetch_waits = false;      // for the SDRAM
  bool line_for_code = false;    // a line began to be read from the SDRAM
  bool access_for_data = false;  // a line, or a write
  bool reset = false;
  bool core_ticked = true;      // the core's clock rose too
  std::uint32_t fifo_fill = 0;  // records in the capture block
  std::uint32_t changed = 0;    // inputs whose edges were stamped
  std::uint32_t levels = 0;     // after that
  std::int64_t stamp_ticks = 0;
};

/// A Verilated chip (firmware/rtl/soc/pharos_chip.v, firmware/rtl/up5k/up5k_chip.v), one tick of its fastest clock at a
/// time.
class ChipDevice {
 public:
  virtual ~ChipDevice() = default;
  virtual double tick_hz() const = 0;
  virtual std::uint32_t inputs() const = 0;
  /// One rising edge of the clock with these inputs before it; outputs before it.
  virtual ChipOutputs tick(const ChipInputs& inputs) = 0;
  /// The capture block's counter, in 20 ns.
  virtual std::int64_t ticks() const = 0;
  virtual void set_ticks(std::int64_t ticks) = 0;
  /// Words of the boot ROM.
  virtual void set_rom(std::span<const std::uint8_t> bytes) = 0;
  /// Bytes of the RAM from its first address on.
  virtual void set_ram(std::span<const std::uint8_t> bytes) = 0;
  virtual std::uint8_t ram(std::uint32_t offset) const = 0;
};

std::unique_ptr<ChipDevice> make_chip_device();
std::unique_ptr<ChipDevice> make_up5k_device();

}  // namespace pharos::rtl
