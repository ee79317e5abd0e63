// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tools/sim/optics/lens.hpp"

namespace pharos::sim {

/// The rays (x/z, y/z) that arrive at a regular grid of points in the image. The lens distortion is inverted once a
/// point when the grid is made (some 0.1 us each). Making one throws host::InputError where no light reaches a point:
/// the distortion folds over inside the image.
class RayGrid {
 public:
  /// At the pixels' centres, and at those of `border_px` more all around the image: width + 2 border_px columns.
  static RayGrid pixel_centres(const Lens& lens, int border_px);
  /// At the pixels' corners: (width + 1) x (height + 1), pixel (u, v) lying between (u, v) and (u + 1, v + 1).
  static RayGrid pixel_corners(const Lens& lens);
  /// `per_side` squared in every pixel, spread evenly over its area.
  static RayGrid inside_pixels(const Lens& lens, int per_side);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const Vector2& at(int column, int row) const { return *row_begin(row, column); }
  /// The rays of a row, from `column` on, lie one behind the other.
  const Vector2* row_begin(int row, int column = 0) const {
    return rays_.data() + static_cast<std::ptrdiff_t>(row) * columns_ + column;
  }

 private:
  RayGrid(const Lens& lens, double first_px, double step_px, int columns, int rows);

  int columns_;
  int rows_;
  std::vector<Vector2> rays_;
};

}  // namespace pharos::sim
