// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/bit_image.hpp"

namespace pharos::tof {

/// Maximum rows or columns of a stored outline; a region that spans more is larger than any connector.
inline constexpr std::int32_t kMaxRegionSide_px = 160;

/// A connected region of a mask, its outline by rows and by columns.
struct Region {
  std::int32_t area_px = 0;
  double u_px = 0.0;  ///< centroid
  double v_px = 0.0;
  std::int32_t left = 0, right = 0, top = 0, bottom = 0;  ///< bounds, included

  /// First and last pixel of each row from `top` and of each column from `left`.
  struct Extent {
    std::int16_t first = 0;
    std::int16_t last = 0;
  };
  std::array<Extent, static_cast<std::size_t>(kMaxRegionSide_px)> row{};
  std::array<Extent, static_cast<std::size_t>(kMaxRegionSide_px)> column{};

  std::int32_t rows() const { return bottom - top + 1; }
  std::int32_t columns() const { return right - left + 1; }
};

struct RegionWorkspace {
  /// Pixels on the region's front; every pixel is added once.
  std::array<std::uint32_t, static_cast<std::size_t>(kMaxPixels)> front;
};

/// Grows one region from a seed over the mask's 4-neighbours (paper 000, steps 2 and 3) and removes it from the mask.
/// False where it spans more than kMaxRegionSide_px either way: removed all the same, outline not filled in.
bool grow_region(BitImage& mask, std::int32_t seed_u, std::int32_t seed_v, RegionWorkspace& workspace, Region& region);

}  // namespace pharos::tof
