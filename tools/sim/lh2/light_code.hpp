// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos::sim {

/// What identifies the light of a Lighthouse 2.0 station: public figures of its channel, 0..15.
struct ChannelCode {
  double turn_48MHz = 0.0;     // rotor period, ticks of 48 MHz
  std::uint32_t taps[2] = {};  // of the sequence that carries a 0 or a 1 of OOTX
};

ChannelCode channel_code(std::size_t channel);

/// Bits of a sequence from the sync on, one for each 6 MHz period of a turn.
std::vector<bool> light_bits(std::uint32_t taps, std::size_t count);

/// Times at which biphase mark code changes its level, in bits since the sync, for the bits from `from` to before `to`.
std::vector<double> level_changes(const std::vector<bool>& bits, double from, double to);

}  // namespace pharos::sim
