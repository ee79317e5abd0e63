// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pharos::sim {

/// A place in a pixel: columns and rows from its middle.
using Subpixel = std::array<double, 2>;

/// Hammersley's points: every row and column of a 16 x 16 grid once, so that straight edges are covered evenly.
constexpr std::array<Subpixel, 16> make_hammersley_subpixels() {
  std::array<Subpixel, 16> points{};
  for (int i = 0; i < 16; ++i) {
    const int reversed = (i & 1) << 3 | (i & 2) << 1 | (i & 4) >> 1 | (i & 8) >> 3;
    points[static_cast<std::size_t>(i)] = {(i + 0.5) / 16.0 - 0.5, (reversed + 0.5) / 16.0 - 0.5};
  }
  return points;
}
inline constexpr std::array<Subpixel, 16> kHammersleySubpixels = make_hammersley_subpixels();

/// `count` (even) places of the same weight, spread as a pixel's own width blurred by a Gaussian of `blur_px` spreads
/// light: an even sequence (Roberts' R2) rather than a grid, which would jump where an edge runs along it, and its
/// mirror image, so that nothing is moved.
std::vector<Subpixel> blurred_subpixels(int count, double blur_px);
/// How far from the middle they lie at most, along columns and rows.
inline double blurred_subpixel_reach(double blur_px) { return 0.5 + 3.5 * blur_px; }

}  // namespace pharos::sim
