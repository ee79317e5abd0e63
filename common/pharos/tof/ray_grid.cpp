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

}  // namespace pharos::tof
