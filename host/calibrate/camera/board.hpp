// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/geometry/types.hpp"

namespace pharos::calibrate {

enum class BoardKind : std::uint8_t { kDots, kChessboard };

/// A flat calibration board. Frame Board: x along the columns, y along the rows, z away from the viewer; the origin is
/// the first dot or the first inner corner.
struct Board {
  BoardKind kind = BoardKind::kDots;
  int columns = 12;  // of dots, or of inner corners
  int rows = 8;
  double pitch_m = 0.02;
  double radius_m = 0.005;  // of dots

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  int column_of(std::size_t index) const { return static_cast<int>(index) % columns; }
  int row_of(std::size_t index) const { return static_cast<int>(index) / columns; }
  /// Position of a dot's centre or of a corner, m.
  Vector3 point_m(std::size_t index) const { return {column_of(index) * pitch_m, row_of(index) * pitch_m, 0.0}; }
};

}  // namespace pharos::calibrate
