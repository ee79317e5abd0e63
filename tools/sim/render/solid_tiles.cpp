// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/render/solid_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pharos::sim {
namespace {

// The cone around a tile's rays, those between its pixels and their neighbours included.
struct TileCone {
  Vector3 axis = Vector3::UnitZ();
  double half_angle_rad = std::numbers::pi;  // everything

  TileCone(const Lens& lens, const LensRays& rays, int first_u, int first_v, int side_px) {
    const double left = first_u - 1.0, right = std::min(first_u + side_px, lens.width_px);
    const double top = first_v - 1.0, bottom = std::min(first_v + side_px, lens.height_px);
    std::array<Vector3, 4> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto ray = rays.at(k % 2 == 0 ? left : right, k / 2 == 0 ? top : bottom);
      if (!ray) return;
      corners[k] = Vector3(ray->x(), ray->y(), 1.0).normalized();
    }
    axis = (corners[0] + corners[1] + corners[2] + corners[3]).normalized();
    double widest = 0.0;
    for (const Vector3& corner : corners) widest = std::max(widest, angle_to(corner));
    half_angle_rad = 1.05 * widest;  // a distorting lens bends the sides by less
  }

  double angle_to(const Vector3& direction) const {
    return std::atan2(axis.cross(direction).norm(), axis.dot(direction));
  }
  bool meets(const Vector3& centre, double radius) const {
    const double distance = centre.norm();
    return distance <= radius || angle_to(centre) <= half_angle_rad + std::asin(radius / distance);
  }
};

}  // namespace

LensRays::LensRays(const Lens& lens) : lens_(lens), plain_(!has_distortion(lens)) {
  if (plain_) return;
  columns_ = lens.width_px / kStep_px + 3;
  const int rows = lens.height_px / kStep_px + 3;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Vector2 seen = seen_at((column - 1) * kStep_px, (row - 1) * kStep_px);
      const auto ray = undistorted(lens, seen, column > 0 && rays_.back() ? *rays_.back() : seen);
      rays_.push_back(ray);
    }
  }
}

Tiles::Tiles(const Lens& lens, const LensRays& rays, const std::vector<Bounds>& bounds, const Matrix3& R_scene_camera,
             const Vector3& eye)
    : columns_((lens.width_px + kTile_px - 1) / kTile_px), rows_((lens.height_px + kTile_px - 1) / kTile_px) {
  std::vector<Vector3> centres;
  for (const Bounds& b : bounds) centres.emplace_back(R_scene_camera.transpose() * (b.centre_m - eye));
  lists_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const TileCone cone(lens, rays, column * kTile_px, row * kTile_px, kTile_px);
      auto& list = lists_[static_cast<std::size_t>(row * columns_ + column)];
      for (std::size_t k = 0; k < bounds.size(); ++k) {
        if (cone.meets(centres[k], bounds[k].radius_m)) list.push_back(static_cast<std::uint16_t>(k));
      }
    }
  }
}

}  // namespace pharos::sim
