// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::lighthouse {

/// What the input stage sorts and puts on the time base: a whole pulse (stamped at its fall) or one edge.
struct LightEvent {
  enum class Kind : std::uint8_t { kPulse, kRise, kFall };

  std::int64_t stamp_ticks = 0;
  std::uint16_t width_ticks = 0;  // of a pulse; at most kLongestPulse_ticks
  std::uint8_t sensor = 0;
  Kind kind = Kind::kPulse;
};

}  // namespace pharos::lighthouse
