// SPDX-License-Identifier: Apache-2.0
#pragma once

// INTERFACE AGREED, implementation follows: edges or pulses in, sweeps and OOTX payloads out.
#include <optional>

#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::lighthouse {

class Decoder {
 public:
  void push(const Edge& edge);
  void push(const RawPulse& pulse);
  /// End of the input: gives out what is still held back.
  void flush();
  std::optional<Sweep> take_sweep();
  std::optional<OotxPayload> take_ootx();
  const DecoderCounters& counters() const { return counters_; }

 private:
  DecoderCounters counters_;
};

}  // namespace pharos::lighthouse
