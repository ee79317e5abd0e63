// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/capacity.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/light_event.hpp"
#include "pharos/lighthouse/pulse.hpp"

namespace pharos::lighthouse {

/// Pairs the edges of each sensor, which come in order of time, to pulses.
///
/// Two rises: the fall between them was lost, the newer one counts (one edge dropped). Two falls: the rise was lost,
/// the second is dropped. A fall later than the longest credible pulse: both are dropped, the pulse never ended.
class EdgePairing {
 public:
  std::optional<Pulse> push(const LightEvent& edge, DecoderCounters& counters);
  /// End of the input: edges that still wait for their partner never ended.
  void end(DecoderCounters& counters);

 private:
  std::array<std::int64_t, kMaxSensors> rise_ticks_{};
  std::uint32_t high_ = 0;  // bit per sensor
};

}  // namespace pharos::lighthouse
