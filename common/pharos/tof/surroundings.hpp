// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "pharos/tof/height_image.hpp"
#include "pharos/tof/regions.hpp"

namespace pharos::tof {

/// Surroundings of a region: heights in a frame as wide as the region itself.
struct Surroundings {
  double base_m = 0.0;   ///< median
  double sigma_m = 0.0;  ///< of one sample, robust
  std::size_t samples = 0;
  std::int32_t stride_px = 1;  ///< between samples
};

/// Below this many samples nothing surrounds the region but space; base and sigma are then 0.
inline constexpr std::size_t kMinSurroundings = 8;

Surroundings surroundings_of(ImageView<const std::uint16_t> heights, const Region& region);

/// Marks in `faces` those pixels of the region's bounds that lie higher than halfway between the region's face and its
/// surroundings. The local threshold (5) marks half of any flat foil beside a face, and these noise pixels join it; at
/// half the step there are none. Nothing where the step is less than `min_height_m`.
void mark_face(ImageView<const std::uint16_t> heights, const Region& region, double min_height_m, BitImage& faces);

}  // namespace pharos::tof
