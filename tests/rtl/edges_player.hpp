// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"

namespace pharos::rtl {

/// A record as firmware reads it over the bus: the four words from STATUS on, in their order.
struct RecordWords {
  std::uint32_t status = 0;
  std::uint32_t time = 0;
  std::uint32_t changed = 0;
  std::uint32_t levels = 0;

  bool operator==(const RecordWords&) const = default;
};

struct PlayOptions {
  /// The reader polls every so many ticks, and reads one record if there is one. At least 8.
  std::uint32_t service_ticks = 250;
  /// Skips ticks in which nothing can happen. Without it every tick is simulated.
  bool skip_idle = true;
};

struct PlayedEdges {
  std::vector<RecordWords> records;
  /// Pulses that are impossible on pins: of length zero or less, or begun before the previous one of that sensor ended.
  std::size_t pulses_left_out = 0;
  std::uint32_t lost_edges = 0;
  /// Largest number of records in STATUS.
  std::uint32_t worst_fill = 0;
  std::uint64_t simulated_ticks = 0;
};

/// Puts a recording on the pins of the Verilated capture block (32 inputs, 512 records), tick by tick, and reads its
/// FIFO over the bus like the firmware.
///
/// The counter is set so that TIME of an edge's record is the low word of that edge's tick in the recording (corrected
/// for the latency of the block). Pulses may come in any order.
PlayedEdges play_edges(std::span<const lighthouse::RawPulse> pulses, const PlayOptions& options = {});

}  // namespace pharos::rtl
