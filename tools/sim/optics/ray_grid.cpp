// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/ray_grid.hpp"

#include <cmath>
#include <string>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

[[noreturn]] void refuse(double u_px, double v_px) {
  throw host::InputError("camera: distortion: no light reaches pixel " + std::to_string(std::lround(u_px)) + ", " +
                         std::to_string(std::lround(v_px)) +
                         " under this distortion; use terms that hold over the whole image");
}

}  // namespace

RayGrid RayGrid::pixel_centres(const Lens& lens, int border_px) {
  return {lens, static_cast<double>(-border_px), 1.0, lens.width_px + 2 * border_px, lens.height_px + 2 * border_px};
}

RayGrid RayGrid::pixel_corners(const Lens& lens) { return {lens, -0.5, 1.0, lens.width_px + 1, lens.height_px + 1}; }

RayGrid RayGrid::inside_pixels(const Lens& lens, int per_side) {
  return {lens, 0.5 / per_side - 0.5, 1.0 / per_side, per_side * lens.width_px, per_side * lens.height_px};
}

RayGrid::RayGrid(const Lens& lens, double first_px, double step_px, int columns, int rows)
    : columns_(columns), rows_(rows) {
  rays_.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = first_px + column * step_px, v = first_px + row * step_px;
      const Vector2 seen((u - lens.cx_px) / lens.fx_px, (v - lens.cy_px) / lens.fy_px);
      // Newton's method starts at the neighbour: from the left, else from above.
      const Vector2& start = column > 0 ? rays_.back() : row > 0 ? at(0, row - 1) : seen;
      const std::optional<Vector2> ray = undistorted(lens, seen, start);
      if (!ray) refuse(u, v);
      rays_.push_back(*ray);
    }
  }
}

}  // namespace pharos::sim
