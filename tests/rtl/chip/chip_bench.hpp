// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"
#include "rtl/chip/chip_device.hpp"
#include "rtl/chip/spi_flash_model.hpp"
#include "rtl/chip/uart_line.hpp"

namespace pharos::rtl {

/// What was counted while the chip ran.
struct ChipCounts {
  std::uint64_t ticks = 0;  // of the core's clock, out of reset
  std::uint64_t instructions = 0;
  std::uint32_t worst_fill = 0;  // records in the capture block
  // Of the memory outside the chip.
  std::uint64_t external_fetches = 0;
  std::uint64_t fetch_waits = 0;  // ticks
  std::uint64_t lines_for_code = 0;
  std::uint64_t accesses_for_data = 0;
};

/// The chip with everything around it: photodiodes, configuration flash, serial line.
class ChipBench {
 public:
  static constexpr std::size_t kFlashBytes = 2 << 20;  // EPCS16

  explicit ChipBench(std::unique_ptr<ChipDevice> device = make_chip_device())
      : device_(std::move(device)), flash_(kFlashBytes), line_(device_->tick_hz()) {}

  ChipDevice& device() { return *device_; }
  SpiFlashModel& flash() { return flash_; }
  UartLine& line() { return line_; }
  SdramModel& sdram() { return sdram_; }

  /// Power on: memories and counter as set before, everything else reset.
  void power_on();
  /// A ROM that only jumps to the RAM, and the program there: starts without the loader.
  void start_in_ram(std::span<const std::uint8_t> program);
  /// The same with the program in the SDRAM.
  void start_in_sdram(std::span<const std::uint8_t> program);
  /// Pulses whose rise and fall the capture block is to stamp at their ticks; those of inputs that it lacks are left
  /// out.
  void set_light(std::span<const lighthouse::RawPulse> pulses);
  /// Runs until the capture block's counter has this value.
  void run_until(std::int64_t ticks);
  /// Runs for so many ticks, also where a reset of the chip clears that counter.
  void run(std::int64_t ticks);

  /// The pulses as the capture block stamped them, in the order of their ends, since the light was set.
  const std::vector<lighthouse::RawPulse>& stamped() const { return stamped_; }
  /// Bytes that the chip sent since the last call.
  std::vector<std::uint8_t> take_received();
  /// Counts since the last call.
  ChipCounts take_counts();

 private:
  struct PinEdge {
    std::int64_t tick;
    std::uint32_t bit;
  };
  void tick();
  void note_stamps(const ChipOutputs& outputs);

  std::unique_ptr<ChipDevice> device_;
  SpiFlashModel flash_;
  UartLine line_;
  SdramModel sdram_;
  ChipInputs inputs_;
  std::vector<PinEdge> edges_;
  std::size_t next_edge_ = 0;
  std::vector<lighthouse::RawPulse> stamped_;
  std::array<std::int64_t, 32> rises_{};
  std::vector<std::uint8_t> received_;
  ChipCounts counts_;
};

}  // namespace pharos::rtl
