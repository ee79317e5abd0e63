// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/convert/crazyflie_blocks.hpp"
#include "tools/convert/frame_clock.hpp"

namespace pharos::convert {

/// A hit of a block, on the log's clock.
struct FramedHit {
  double time_s = 0.0;
  AngleKey key{};
  double angle_rad = 0.0;
};

/// The hits of one LH2 station's blocks by the decoder board's stamps. An angle tells when the light was since the
/// turn's begin, so each light of its sensor tells a begin; a block's turn is the one in which most of its angles had
/// their light. Angles that had it are hits, also those that are the same as before; new ones that had it in no turn
/// are counted in `untimed`.
std::vector<FramedHit> framed_hits(const FrameClock& clock, double period_s, const std::vector<Block>& blocks,
                                   std::size_t& untimed);

}  // namespace pharos::convert
