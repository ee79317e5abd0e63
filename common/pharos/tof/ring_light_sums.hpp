// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/tof/ring_pixels.hpp"

namespace pharos::tof {

/// Pixels that are processed together.
inline constexpr std::size_t kLightLanes = 4;
inline constexpr std::size_t kMaxLightColumn = kMaxRingPixels + (kLightLanes - 1) * kRingDirections;

/// The pixels of the light's fit in columns, those of a direction together, each direction's filled up to whole lanes
/// by pixels far beyond the ring that say nothing.
struct RingLightColumns {
  alignas(16) std::array<float, kMaxLightColumn> beyond_px;  ///< RingPixel::beyond_outer_px
  alignas(16) std::array<float, kMaxLightColumn> layer;      ///< light from the ring's height, counts
  alignas(16) std::array<float, kMaxLightColumn> size;       ///< of the last pass' residuals, counts
  std::array<std::uint16_t, kRingDirections> begin{}, count{};
};
inline constexpr float kFarBeyond_px = 1e3F;

/// What all pixels have in common in a pass.
struct RingProfile {
  double blur_px = 0.0;
  std::array<double, 2> walls{};  ///< brightness over that of the cosine law
  double limit = 0.0;             ///< residuals beyond count as much as one of this size; 0: all count fully
};

/// Sums over the pixels of one direction. Unknowns: the outer and the inner edge's place, px; the logarithm of the
/// blur; the brightness of the wall in sight.
struct RingLightSums {
  static constexpr std::size_t kUnknowns = 4;
  /// Lower triangle, row by row.
  std::array<double, kUnknowns*(kUnknowns + 1) / 2> normal{};
  std::array<double, kUnknowns> right{}, with_light{};
  double light_square = 0.0, light_right = 0.0;
  /// Of the pixels that say something of an edge: for SectorSums.
  struct Shared {
    double count = 0.0, weights = 0.0, sum = 0.0, squares = 0.0;
  };
  std::array<Shared, 2> shared{};

  double normal_at(std::size_t row, std::size_t column) const { return normal[row * (row + 1) / 2 + column]; }
};

/// The outer edge's wall where that is wider in the image, else the inner one's.
inline std::size_t wall_side(const RingDirection& one) { return one.foot_px[0] >= one.foot_px[1] ? 0 : 1; }

/// One direction's pixels about the present profile; their residuals go to columns.size.
RingLightSums light_sums(const RingDirection& one, std::size_t direction, const RingProfile& profile,
                         RingLightColumns& columns);

}  // namespace pharos::tof
