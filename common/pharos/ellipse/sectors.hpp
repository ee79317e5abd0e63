// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/ellipse/arc.hpp"
#include "pharos/ellipse/ellipse.hpp"

namespace pharos::ellipse {

/// Maximum sectors of the contour in which points are searched; small ellipses have fewer, some 4 px long.
inline constexpr int kMaxSectors = 64;

/// Parts of a contour, 0 to 1: of its length and of its full turn.
struct ContourFractions {
  double length = 0.0, turn = 0.0;                ///< in sectors that have points
  double inside_length = 1.0, inside_turn = 1.0;  ///< inside the image
};

/// Bits of the first `count` sectors, and of those next to them around the contour.
std::uint64_t with_neighbours(std::uint64_t sectors, int count);

/// The contour cut into sectors of equal steps around the diamond |x| + |y| = 1: no trigonometry, and so identical on
/// every machine. Points are in units of the axes: on the unit circle where they are on the contour.
class Sectors {
 public:
  /// `ellipse` must outlive it. `width_px` of 0: an image without borders.
  Sectors(const Ellipse& ellipse, std::int32_t width_px, std::int32_t height_px);

  void mark(int sector) { marked_ |= std::uint64_t{1} << sector; }
  ContourFractions fractions() const;

  int count() const { return 4 * quarter_; }
  int sector_of(PointF p) const;
  /// A bit for each sector within `reach` sectors of a gap: two or more in succession, inside the image, without
  /// points.
  std::uint64_t beside_gaps(int reach) const;

 private:
  bool outside(int sector, double cosine, double sine) const;

  const Ellipse& e_;
  double right_, bottom_;
  bool cut_ = false;  // by the image's border
  int quarter_;
  std::uint64_t marked_ = 0;
};

}  // namespace pharos::ellipse
