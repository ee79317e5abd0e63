// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/lighthouse/lh2_channels.hpp"

namespace pharos::lighthouse {

/// A burst identified: whose light, and when in its turn. Integers only; what a block in logic may deliver.
struct Lh2Beam {
  std::int64_t time_sixths = 0;    // when the bit of place `place` began, 1/6 tick
  std::int64_t centre_sixths = 0;  // middle of the light
  std::uint32_t place = 0;         // bits since the sync, 0..131070
  std::uint16_t width_ticks = 0;   // of the light
  std::uint8_t sensor = 0;
  std::uint8_t channel = 0;  // 0..15
  bool slow_bit = false;     // which of the channel's two sequences: a bit of OOTX
  std::uint8_t bits = 0;     // bits that agree with the sequence
};

}  // namespace pharos::lighthouse
