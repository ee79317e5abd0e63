// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// A simulated camera's lens, OpenCV's model: focal lengths and principal point in pixels, pixel (0, 0) being the
/// centre of the first; distortion k1, k2, p1, p2, k3 (radial and decentring). Camera frame: x right, y down, z ahead;
/// a ray is (x/z, y/z). Independent of the core's camera, so that tests detect an error in either.
struct Lens {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 5> distortion{};
};

/// The values of paper 000, table 1.
inline constexpr Lens kPaperLens{640, 480, 608.61, 605.04, 321.85, 238.94, {-0.1991, 0.0809, 0.0021, -0.0002, 0.0}};

/// Without distortion, square pixels, principal point in the image's middle.
Lens centred_lens(std::int32_t width_px, std::int32_t height_px, double focal_px);

bool has_distortion(const Lens& lens);

/// Where a ray arrives, in focal lengths from the principal point:
/// x' = x (1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x y + p2 (r2 + 2 x2), y' = y (...) + p1 (r2 + 2 y2) + 2 p2 x y.
/// Inline, as pixel_of is: called for every point of a contour.
inline Vector2 distorted(const Lens& lens, const Vector2& ray) {
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  const double x = ray.x(), y = ray.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

/// The ray that arrives at `seen`: Newton's method on distorted() from `start`, to rounding. Nothing where no light
/// arrives: beyond the radius at which the distortion folds the picture over.
std::optional<Vector2> undistorted(const Lens& lens, const Vector2& seen, const Vector2& start);

/// Pixel of a ray, and of a point in the camera's frame (z > 0); it may lie outside the image.
inline Vector2 pixel_of(const Lens& lens, const Vector2& ray) {
  const Vector2 seen = distorted(lens, ray);
  return {lens.fx_px * seen.x() + lens.cx_px, lens.fy_px * seen.y() + lens.cy_px};
}
inline Vector2 pixel_of(const Lens& lens, const Vector3& point_camera_m) {
  return pixel_of(lens, Vector2(point_camera_m.head<2>() / point_camera_m.z()));
}

/// Conversion to another type of camera (`Optics`: width, height, fx, fy, cx, cy, distortion in this
/// order), for the files that the host writes.
template <typename Optics>
Optics optics_as(const Lens& lens) {
  return {lens.width_px, lens.height_px, lens.fx_px, lens.fy_px, lens.cx_px, lens.cy_px, lens.distortion};
}
template <typename Optics>
Lens lens_of(const Optics& intrinsics) {
  return {intrinsics.width_px, intrinsics.height_px, intrinsics.fx_px,     intrinsics.fy_px,
          intrinsics.cx_px,    intrinsics.cy_px,     intrinsics.distortion};
}

}  // namespace pharos::sim
