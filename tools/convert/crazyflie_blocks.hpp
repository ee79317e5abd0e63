// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "tools/convert/crazyflie_log.hpp"

namespace pharos::convert {

using AngleKey = std::array<std::uint8_t, 2>;  // sensor, plane
using Angles = std::map<AngleKey, double>;     // rad, 0 straight ahead

/// Angles of one station after a turn.
struct Block {
  double logged_s = 0.0;
  Angles logged;         // all of them
  Angles angles;         // those that are new: what a sensor did not see keeps its last value
  double begin_s = 0.0;  // of the turn, LH1: of the slot of plane 0
  double delay_s = 0.0;  // after even turns
  std::size_t run = 0;   // of blocks without a long gap
};

using Blocks = std::map<std::uint8_t, std::vector<Block>>;  // by station

/// Blocks that have an angle that the station's block before has not. `repeated`: angles that are not new.
Blocks new_blocks(const std::vector<LoggedAngle>& logged, std::size_t& repeated);

/// Time of a hit since the turn's begin (LH1: since that of plane 0's slot), in turns.
double turns_of(int generation, std::uint8_t plane, double angle_rad);

}  // namespace pharos::convert
