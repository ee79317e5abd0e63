// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pharos/geometry/types.hpp"
#include "tools/sim/optics/lens.hpp"
#include "tools/sim/render/solid_shapes.hpp"

namespace pharos::sim {

/// Rays (x/z, y/z) of any place of the image: of a lens that distorts, linear between places 4 px apart, 0.001 px off.
class LensRays {
 public:
  explicit LensRays(const Lens& lens);

  /// Up to a pixel outside the image.
  std::optional<Vector2> at(double u, double v) const {
    if (plain_) return seen_at(u, v);
    const double x = u / kStep_px + 1.0, y = v / kStep_px + 1.0;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const auto* above = &rays_[static_cast<std::size_t>(row * columns_ + column)];
    const auto* below = above + columns_;
    if (!above[0] || !above[1] || !below[0] || !below[1]) return std::nullopt;
    const double a = x - column, b = y - row;
    return Vector2((1 - b) * ((1 - a) * *above[0] + a * *above[1]) + b * ((1 - a) * *below[0] + a * *below[1]));
  }

 private:
  static constexpr int kStep_px = 4;
  Vector2 seen_at(double u, double v) const {
    return {(u - lens_.cx_px) / lens_.fx_px, (v - lens_.cy_px) / lens_.fy_px};
  }

  const Lens& lens_;
  bool plain_;
  int columns_ = 0;
  std::vector<std::optional<Vector2>> rays_;
};

/// Which solids may be seen in each tile of the image, by the spheres around them.
class Tiles {
 public:
  Tiles(const Lens& lens, const LensRays& rays, const std::vector<Bounds>& bounds, const Matrix3& R_scene_camera,
        const Vector3& eye);
  const std::vector<std::uint16_t>& at(int u, int v) const {
    return lists_[static_cast<std::size_t>((v / kTile_px) * columns_ + u / kTile_px)];
  }

 private:
  static constexpr int kTile_px = 16;

  int columns_, rows_;
  std::vector<std::vector<std::uint16_t>> lists_;
};

}  // namespace pharos::sim
