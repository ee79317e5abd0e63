// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ray_grid.hpp"

namespace pharos::tof {

bool RayGrid::prepare(const PinholeCamera& camera) {
  if (ready_ && camera == camera_) return true;
  ready_ = false;
  if (!is_usable(camera) || camera.width_px > kMaxWidth_px || camera.height_px > kMaxHeight_px) return false;
  camera_ = camera;
  // One node beyond the last pixel, so that every pixel lies in a cell.
  columns_ = (camera.width_px - 1) / kStep_px + 2;
  rows_ = (camera.height_px - 1) / kStep_px + 2;
  std::size_t count = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto ray = undistort(camera, Vector2(column * kStep_px, row * kStep_px));
      if (!ray) return false;
      nodes_[count++] = {ray->x(), ray->y()};
    }
  }
  ready_ = true;
  return true;
}

void RayGrid::row_at(std::int32_t u, std::int32_t v, std::int32_t count, Row<float>& row) const {
  const double t = static_cast<double>(v % kStep_px) / kStep_px;
  const auto between = [t](double above, double below) { return static_cast<float>((1.0 - t) * above + t * below); };
  row.first_ = u % kStep_px;
  const Node* node = node_at(u / kStep_px, v / kStep_px);
  const Node* below = node + columns_;
  float *out_x = row.x_.data(), *out_y = row.y_.data();
  float x = between(node[0].x, below[0].x), y = between(node[0].y, below[0].y);
  for (std::int32_t k = -row.first_; k < count; k += kStep_px) {
    ++node;
    ++below;
    const float next_x = between(node[0].x, below[0].x), next_y = between(node[0].y, below[0].y);
    const float step_x = (next_x - x) / kStep_px, step_y = (next_y - y) / kStep_px;
    for (int s = 0; s < kStep_px; ++s) out_x[s] = x + static_cast<float>(s) * step_x;
    for (int s = 0; s < kStep_px; ++s) out_y[s] = y + static_cast<float>(s) * step_y;
    out_x += kStep_px;
    out_y += kStep_px;
    x = next_x;
    y = next_y;
  }
}

void RayGrid::row_at(std::int32_t u, std::int32_t v, std::int32_t count, Row<double>& row) const {
  constexpr std::array<double, kStep_px> kFractions = {0.0, 0.25, 0.5, 0.75};
  const double t = static_cast<double>(v % kStep_px) / kStep_px;
  row.first_ = u % kStep_px;
  const Node* node = node_at(u / kStep_px, v / kStep_px);
  const Node* below = node + columns_;
  double *out_x = row.x_.data(), *out_y = row.y_.data();
  for (std::int32_t k = -row.first_; k < count; k += kStep_px, ++node, ++below) {
    for (const double s : kFractions) {
      *out_x++ = (1.0 - t) * ((1.0 - s) * node[0].x + s * node[1].x) + t * ((1.0 - s) * below[0].x + s * below[1].x);
      *out_y++ = (1.0 - t) * ((1.0 - s) * node[0].y + s * node[1].y) + t * ((1.0 - s) * below[0].y + s * below[1].y);
    }
  }
}

}  // namespace pharos::tof
