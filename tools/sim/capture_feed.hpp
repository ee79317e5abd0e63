// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::sim {

/// Simulates a capture block on the photodiodes' pins: converts pulses to the words of its registers, as the emulated
/// board reads them (firmware/board/qemu_virt/capture_replay.hpp). The FIFO is always read in time: no gap but the
/// first, no lost edge. tests/rtl/edges_through_capture simulates the Verilated block itself.
class CaptureFeed {
 public:
  /// Pulses in any order, but those that begin before a time must be given before advance() to that time.
  void push(const lighthouse::RawPulse& pulse);
  /// Advances the counter: everything earlier is in bytes() afterwards, with a reading of the counter at least every
  /// millisecond. Must not go backwards.
  void advance(std::int64_t now_ticks);
  /// Marks the end, at which the emulator stops.
  void end();

  /// Words produced so far; the caller takes and clears them.
  std::vector<std::uint8_t>& bytes() { return bytes_; }
  /// Number of pulses that cannot occur on pins: of zero length, begun before the end of the previous one on that
  /// sensor, or with an old stamp (from devices that send old pulses at their start).
  std::uint64_t pulses_left_out() const { return left_out_; }

 private:
  struct PinEdge {
    std::int64_t tick;
    std::uint32_t bit;
  };
  struct Later {
    bool operator()(const PinEdge& a, const PinEdge& b) const { return a.tick > b.tick; }
  };
  void pass_time(std::int64_t tick);
  void put_record(std::int64_t tick, std::uint32_t changed);
  void put_time(std::int64_t now_ticks);
  void put(std::uint32_t word);

  std::priority_queue<PinEdge, std::vector<PinEdge>, Later> edges_;
  std::array<std::optional<std::int64_t>, kMaxSensors> dark_since_;
  std::optional<std::int64_t> given_until_;
  std::int64_t time_given_ = 0;
  bool first_record_ = true;
  std::uint32_t levels_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t left_out_ = 0;
};

}  // namespace pharos::sim
