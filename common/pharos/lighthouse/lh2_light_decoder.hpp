// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/lighthouse/lh2_identify.hpp"
#include "pharos/lighthouse/lh2_sweep_decoder.hpp"

namespace pharos::lighthouse {

/// Light of Lighthouse 2.0 from receivers' outputs to sweeps: bursts, bits, places in sequences, syncs.
///
/// Each stage stands alone (lh2_burst, lh2_biphase, lh2_identify, Lh2SweepDecoder), so that a block in logic can take
/// over the first ones. 41 KiB with 32 sensors.
class Lh2LightDecoder {
 public:
  /// `sequences` must outlive this.
  explicit Lh2LightDecoder(const Lh2Sequences& sequences) : sequences_(sequences) {}

  void push(const Lh2Edge& edge);
  void advance(std::int64_t now_ticks);
  void flush();

  std::optional<Lh2Sweep> take_sweep() { return sweeps_.take_sweep(); }
  std::optional<OotxPayload> take_ootx() { return sweeps_.take_ootx(); }
  const Lh2Counters& counters() const { return sweeps_.counters(); }
  const Lh2SweepDecoder& sweeps() const { return sweeps_; }

 private:
  void take(const Lh2Burst& burst);

  std::int64_t looked_ticks_ = 0;
  Lh2BurstCollector collector_;
  const Lh2Sequences& sequences_;
  Lh2SweepDecoder sweeps_;
};

}  // namespace pharos::lighthouse
