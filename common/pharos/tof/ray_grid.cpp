// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ray_grid.hpp"

#include <algorithm>

namespace pharos::tof {

bool RayGrid::prepare(const PinholeCamera& camera) {
  if (ready_ && camera == camera_) return true;
  ready_ = false;
  if (!is_usable(camera) || camera.width_px > kMaxWidth_px || camera.height_px > kMaxHeight_px) return false;
  camera_ = camera;
  // One node beyond the last pixel, so that every pixel lies in a cell.
  columns_ = (camera.width_px - 1) / kStep_px + 2;
  rows_ = (camera.height_px - 1) / kStep_px + 2;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto ray = undistort(camera, Vector2(column * kStep_px, row * kStep_px));
      if (!ray) return false;
      nodes_[static_cast<std::size_t>(row * columns_ + column)] = {ray->x(), ray->y()};
    }
  }
  ready_ = true;
  return true;
}

Vector2 RayGrid::at(double u_px, double v_px) const {
  const double column = u_px / kStep_px;
  const double row = v_px / kStep_px;
  const int left = std::clamp(static_cast<int>(column), 0, columns_ - 2);
  const int top = std::clamp(static_cast<int>(row), 0, rows_ - 2);
  const double s = column - left;
  const double t = row - top;
  const Node* node = &nodes_[static_cast<std::size_t>(top * columns_ + left)];
  const Node* below = node + columns_;
  return {(1.0 - t) * ((1.0 - s) * node[0].x + s * node[1].x) + t * ((1.0 - s) * below[0].x + s * below[1].x),
          (1.0 - t) * ((1.0 - s) * node[0].y + s * node[1].y) + t * ((1.0 - s) * below[0].y + s * below[1].y)};
}

void RayGrid::row_at(std::int32_t u, std::int32_t v, std::int32_t count, Row& row) const {
  const double t = static_cast<double>(v % kStep_px) / kStep_px;
  const auto between = [t](double above, double below) { return static_cast<float>((1.0 - t) * above + t * below); };
  const Node* node = &nodes_[static_cast<std::size_t>(v / kStep_px * columns_)];
  for (std::int32_t k = 0; k < count;) {
    const int cell = (u + k) / kStep_px;
    const int first = (u + k) % kStep_px;
    const Node* left = node + cell;
    const Node* below = left + columns_;
    const float x = between(left[0].x, below[0].x), step_x = (between(left[1].x, below[1].x) - x) / kStep_px;
    const float y = between(left[0].y, below[0].y), step_y = (between(left[1].y, below[1].y) - y) / kStep_px;
    for (int s = first; s < kStep_px && k < count; ++s, ++k) {
      row.x[static_cast<std::size_t>(k)] = x + static_cast<float>(s) * step_x;
      row.y[static_cast<std::size_t>(k)] = y + static_cast<float>(s) * step_y;
    }
  }
}

}  // namespace pharos::tof
