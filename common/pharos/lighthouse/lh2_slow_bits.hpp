// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/lighthouse/lh2_counters.hpp"
#include "pharos/lighthouse/ootx_frames.hpp"

namespace pharos::lighthouse {

/// OOTX of one channel from the choice of sequence: one bit a turn, the same for both planes.
class Lh2SlowBits {
 public:
  /// A beam's bit and turn; turns do not decrease (an older one is left out). Returns the payload that the turn before
  /// completed.
  std::optional<OotxFrames::Payload> push(std::int64_t turn, bool bit, Lh2Counters& counters);
  /// What became of frames.
  const DecoderCounters& frame_counters() const { return frame_counters_; }

 private:
  OotxFrames frames_;
  DecoderCounters frame_counters_;
  std::int64_t turn_ = 0;
  std::int64_t last_pushed_ = 0;
  bool bit_ = false;
  bool open_ = false;
  bool contradicted_ = false;
};

}  // namespace pharos::lighthouse
