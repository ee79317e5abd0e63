// SPDX-License-Identifier: Apache-2.0
#include "rtl/chip/chip_bench.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "firmware/rtl/capture_registers.h"

namespace pharos::rtl {

void ChipBench::power_on() {
  const std::int64_t start = device_->ticks();
  inputs_.power_on_reset = true;
  for (int i = 0; i < 4; ++i) tick();
  inputs_.power_on_reset = false;
  // Reset clears the counter: it is set again as soon as it counts.
  while (device_->ticks() == 0) tick();
  device_->set_ticks(start);
  counts_ = {};
}

void ChipBench::start_in_ram(std::span<const std::uint8_t> program) {
  // lui t0, 0x80001; jr t0
  constexpr std::array<std::uint8_t, 8> kJump{0xB7, 0x12, 0x00, 0x80, 0x67, 0x80, 0x02, 0x00};
  device_->set_rom(kJump);
  device_->set_ram(program);
}

void ChipBench::start_in_sdram(std::span<const std::uint8_t> program) {
  // lui t0, 0x80800; jr t0
  constexpr std::array<std::uint8_t, 8> kJump{0xB7, 0x02, 0x80, 0x80, 0x67, 0x80, 0x02, 0x00};
  device_->set_rom(kJump);
  sdram_.write(0, program);
}

void ChipBench::set_light(std::span<const lighthouse::RawPulse> pulses) {
  edges_.clear();
  next_edge_ = 0;
  stamped_.clear();
  for (const lighthouse::RawPulse& pulse : pulses) {
    if (pulse.sensor >= device_->inputs() || pulse.fall_ticks <= pulse.rise_ticks) continue;
    for (const std::int64_t at : {pulse.rise_ticks, pulse.fall_ticks}) {
      edges_.push_back({at - PHAROS_CAPTURE_LATENCY_TICKS, 1U << pulse.sensor});
    }
  }
  std::ranges::stable_sort(edges_, {}, &PinEdge::tick);
}

void ChipBench::tick() {
  for (; next_edge_ < edges_.size() && edges_[next_edge_].tick <= device_->ticks(); ++next_edge_) {
    inputs_.photodiodes ^= edges_[next_edge_].bit;
  }
  inputs_.uart_receive = line_.transmit();
  const ChipOutputs outputs = device_->tick(inputs_);
  inputs_.spi_in = flash_.tick(outputs.spi_select_n, outputs.spi_clock, outputs.spi_out);
  if (inputs_.power_on_reset) sdram_.restart();
  if (!inputs_.power_on_reset) inputs_.sdram_data = sdram_.tick(outputs.sdram);
  if (outputs.reset || inputs_.power_on_reset) return;  // its pins may show anything
  if (const auto byte = line_.receive(outputs.uart_transmit)) received_.push_back(*byte);
  if (outputs.changed != 0) note_stamps(outputs);
  if (!outputs.core_ticked) return;
  ++counts_.ticks;
  counts_.instructions += outputs.instruction_ended ? 1 : 0;
  counts_.external_fetches += outputs.external_fetch ? 1 : 0;
  counts_.fetch_waits += outputs.fetch_waits ? 1 : 0;
  counts_.lines_for_code += outputs.line_for_code ? 1 : 0;
  counts_.accesses_for_data += outputs.access_for_data ? 1 : 0;
  counts_.worst_fill = std::max(counts_.worst_fill, outputs.fifo_fill);
}

void ChipBench::note_stamps(const ChipOutputs& outputs) {
  for (std::uint32_t sensor = 0; sensor < device_->inputs(); ++sensor) {
    if ((outputs.changed >> sensor & 1U) == 0) continue;
    if ((outputs.levels >> sensor & 1U) != 0) {
      rises_[sensor] = outputs.stamp_ticks;
    } else {
      lighthouse::RawPulse pulse;
      pulse.sensor = static_cast<decltype(pulse.sensor)>(sensor);
      pulse.rise_ticks = rises_[sensor];
      pulse.fall_ticks = outputs.stamp_ticks;
      stamped_.push_back(pulse);
    }
  }
}

void ChipBench::run_until(std::int64_t ticks) {
  while (device_->ticks() < ticks) tick();
}

void ChipBench::run(std::int64_t ticks) {
  for (; ticks > 0; --ticks) tick();
}

std::vector<std::uint8_t> ChipBench::take_received() { return std::exchange(received_, {}); }

ChipCounts ChipBench::take_counts() { return std::exchange(counts_, {}); }

}  // namespace pharos::rtl
