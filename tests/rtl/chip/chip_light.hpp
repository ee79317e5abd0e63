// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"

namespace pharos::rtl {

/// Pulses of a table sensor,rise_ticks,fall_ticks of the first `seconds` of its light.
struct ChipLight {
  std::vector<lighthouse::RawPulse> pulses;
  std::int64_t first_ticks = 0;  // rises
  std::int64_t last_ticks = 0;   // has fallen

  /// The same light so much later.
  void move(std::int64_t ticks);
};

/// Throws host::InputError where there are no edges.
ChipLight read_light(const std::string& path, double seconds);
void write_pulses(const std::string& path, const std::vector<lighthouse::RawPulse>& pulses);

}  // namespace pharos::rtl
