// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tools/sim/optics/ray_grid.hpp"

namespace pharos::sim {

/// Where every pixel of the simulated depth camera looks.
class PixelRays {
 public:
  /// Inverts the distortion at every pixel, which takes some milliseconds. Throws host::InputError where a pixel of
  /// the image has no ray (the distortion folds over inside the image).
  explicit PixelRays(const Lens& lens);

  const Lens& lens() const { return lens_; }

  /// Direction x/z, y/z that pixel (u, v) looks along; u in [-1, width], v in [-1, height].
  const Vector2& ray(int u, int v) const { return grid_.at(u + 1, v + 1); }
  /// Range over depth along the ray of pixel (u, v) of the image: the length of (x/z, y/z, 1).
  double range_per_depth(int u, int v) const {
    return lengths_[static_cast<std::size_t>(v) * static_cast<std::size_t>(lens_.width_px) +
                    static_cast<std::size_t>(u)];
  }
  /// How the direction changes from pixel to pixel: columns d/du, d/dv. u in [0, width), v in [0, height).
  Eigen::Matrix2d slope(int u, int v) const;
  /// Pixel of a point in the camera's frame (z > 0).
  Vector2 project(const Vector3& point_camera_m) const { return pixel_of(lens_, point_camera_m); }

 private:
  Lens lens_;
  RayGrid grid_;
  std::vector<double> lengths_;
};

}  // namespace pharos::sim
