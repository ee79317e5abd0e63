// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::lighthouse {

/// One change of level of one photodiode, as the capture block stamps it. Ticks of 20 ns, 64 bits unwrapped.
struct Edge {
  std::int64_t stamp_ticks = 0;
  std::uint8_t sensor = 0;  // 0..31
  bool rising = false;
};

/// One light pulse on one photodiode, exactly as received: it may be stale, doubled or of implausible length.
struct RawPulse {
  std::int64_t rise_ticks = 0;
  std::int64_t fall_ticks = 0;
  std::uint8_t sensor = 0;
};

/// One light pulse that passed the input stage: in order, on the recording's time base, of a plausible length.
struct Pulse {
  std::int64_t rise_ticks = 0;
  std::int32_t width_ticks = 0;
  std::uint8_t sensor = 0;

  std::int64_t fall_ticks() const { return rise_ticks + width_ticks; }
};

}  // namespace pharos::lighthouse
