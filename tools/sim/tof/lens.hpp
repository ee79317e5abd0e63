// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// What the simulated camera's optics are; the defaults are those of paper 000, table 1. Pixels; 0,0 is the centre of
/// the first pixel. distortion: k1, k2, p1, p2, k3 in the usual polynomial model (radial and decentring).
struct LensModel {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 608.61;
  double fy_px = 605.04;
  double cx_px = 321.85;
  double cy_px = 238.94;
  std::array<double, 5> distortion{-0.1991, 0.0809, 0.0021, -0.0002, 0.0};
};

/// The simulator's own camera model: where every pixel looks. Written apart from the core's, so that a mistake of one
/// shows against the other.
class Lens {
 public:
  /// Inverts the distortion at every pixel, which takes some milliseconds. Throws host::InputError where a pixel of
  /// the image has no ray (the distortion folds over inside the image).
  explicit Lens(const LensModel& model);

  const LensModel& model() const { return model_; }

  /// Direction x/z, y/z that pixel (u, v) looks along; u in [-1, width], v in [-1, height].
  const Vector2& ray(int u, int v) const {
    return rays_[static_cast<std::size_t>(v + 1) * static_cast<std::size_t>(model_.width_px + 2) +
                 static_cast<std::size_t>(u + 1)];
  }
  /// Range over depth along the ray of pixel (u, v) of the image: the length of (x/z, y/z, 1).
  double range_per_depth(int u, int v) const {
    return lengths_[static_cast<std::size_t>(v) * static_cast<std::size_t>(model_.width_px) +
                    static_cast<std::size_t>(u)];
  }
  /// How the direction changes from pixel to pixel: columns d/du, d/dv. u in [0, width), v in [0, height).
  Eigen::Matrix2d slope(int u, int v) const;
  /// Pixel of a point in the camera's frame (z > 0).
  Vector2 project(const Vector3& point_camera_m) const;

 private:
  Vector2 distorted(const Vector2& ray) const;
  std::optional<Vector2> undistorted(const Vector2& seen, const Vector2& start) const;

  LensModel model_;
  std::vector<Vector2> rays_;
  std::vector<double> lengths_;
};

}  // namespace pharos::sim
