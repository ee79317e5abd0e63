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

/// What a capture block on the photodiodes' pins would give its firmware: pulses in, the words of its registers out, as
/// the emulated board reads them (firmware/board/qemu_virt/capture_replay.hpp). A FIFO that is always read in time: no
/// gap but the first, no edge lost. The Verilated block itself is played by tests/rtl/edges_through_capture.
class CaptureFeed {
 public:
  /// In any order, as long as those that begin before a time come before advance() to that time.
  void push(const lighthouse::RawPulse& pulse);
  /// The counter stands here: everything earlier is in bytes() afterwards, and a reading of the counter at least every
  /// millisecond of it. May not run backwards.
  void advance(std::int64_t now_ticks);
  /// The end: the emulator stops when it comes here.
  void end();

  /// Words that wait to be handed over; take what you need and clear it.
  std::vector<std::uint8_t>& bytes() { return bytes_; }
  /// Pulses that pins cannot show: of no length, begun before the one before them on that sensor ended, or stamped
  /// long ago (devices that send old pulses at their start).
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
