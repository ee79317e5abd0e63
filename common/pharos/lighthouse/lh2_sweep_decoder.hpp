// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/ring_buffer.hpp"
#include "pharos/lighthouse/lh2_beam.hpp"
#include "pharos/lighthouse/lh2_counters.hpp"
#include "pharos/lighthouse/lh2_rotor.hpp"
#include "pharos/lighthouse/lh2_slow_bits.hpp"
#include "pharos/lighthouse/lh2_sweep.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"

namespace pharos::lighthouse {

/// Beams of up to 16 stations to sweeps and OOTX payloads. Sync comes from the beams alone (Lh2Rotor).
///
/// Beams come in order of time within 0.1 ms. A sweep is complete when a beam of another plane or turn of its channel
/// comes, or 1 ms after its last hit. Take what is ready after every push.
class Lh2SweepDecoder {
 public:
  void push(const Lh2Beam& beam);
  /// Completes sweeps whose last hit is 1 ms ago.
  void advance(std::int64_t now_sixths);
  /// The end: sweeps still open; beams that wait for a second one are dropped.
  void flush();

  std::optional<Lh2Sweep> take_sweep();
  std::optional<OotxPayload> take_ootx();

  /// Whether a beam belongs to a station that is known: it leads to its sync.
  bool fits(const Lh2Beam& beam) const;
  /// Channels whose rotors run, as bits.
  std::uint32_t channels() const;
  const Lh2Rotor& rotor(std::size_t channel) const { return channel_[channel].rotor; }
  const Lh2Counters& counters() const { return counters_; }
  Lh2Counters& counters() { return counters_; }
  /// What became of a channel's OOTX frames.
  const DecoderCounters& frame_counters(std::size_t channel) const { return channel_[channel].slow.frame_counters(); }

 private:
  struct Channel {
    Lh2Rotor rotor;
    Lh2SlowBits slow;
    Lh2Sweep sweep;  // open where it has hits
    std::int64_t turn = 0;
    std::int64_t last_sixths = 0;  // of its last hit
  };

  void add_hit(Channel& channel, const Lh2Beam& beam, const Lh2Placed& placed);
  void close(Channel& channel);

  static constexpr std::size_t kSweepQueue = kLh2Channels + 2;
  static constexpr std::size_t kOotxQueue = 4;

  std::array<Channel, kLh2Channels> channel_;
  RingBuffer<Lh2Sweep, kSweepQueue> sweeps_;
  RingBuffer<OotxPayload, kOotxQueue> payloads_;
  Lh2Counters counters_;
};

}  // namespace pharos::lighthouse
