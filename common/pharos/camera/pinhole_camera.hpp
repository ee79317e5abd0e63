// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/result.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos {

using Matrix2 = Eigen::Matrix<double, 2, 2>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// Intrinsics and lens distortion, OpenCV's model and order. Frame C: x right, y down, z forward, metres. Pixel (0, 0)
/// is the centre of the first pixel; a ray is (x/z, y/z).
struct PinholeCamera {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  /// k1, k2, p1, p2, k3.
  std::array<double, 5> distortion{};

  friend bool operator==(const PinholeCamera&, const PinholeCamera&) = default;
};

/// Sizes and focal lengths positive, everything finite.
bool is_usable(const PinholeCamera& camera);

enum class CameraFailure : std::uint8_t {
  kBehindCamera,  // z <= 0
  kOutsideModel,  // the distortion folds there: two rays share a pixel, or no ray has it
  kNotConverged,  // undistortion
};
const char* name_of(CameraFailure failure);

/// Pixel of an ideal ray: x' = x (1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x y + p2 (r2 + 2 x2), y' = y (...) + p1 (r2 + 2 y2)
/// + 2 p2 x y; u = fx x' + cx, v = fy y' + cy. Does not detect folds.
Vector2 distort(const PinholeCamera& camera, const Vector2& ray);
/// d pixel / d ray of distort.
Matrix2 distort_jacobian(const PinholeCamera& camera, const Vector2& ray);

/// Ray (x/z, y/z) of a pixel: Newton's method on distort, to 1e-12 of the focal length. The derivative d ray / d pixel
/// is the inverse of distort_jacobian there. kOutsideModel or kNotConverged where the lens has no such pixel. Cost: two
/// or three steps near the middle, none of them with a square root or a transcendental function.
Result<Vector2, CameraFailure> undistort(const PinholeCamera& camera, const Vector2& pixel);

/// Pixel of a point in frame C. It may lie outside the image.
Result<Vector2, CameraFailure> project(const PinholeCamera& camera, const Vector3& point_camera_m);
/// d pixel / d point of project, where that has a result: px per m.
Matrix23 project_jacobian(const PinholeCamera& camera, const Vector3& point_camera_m);

}  // namespace pharos
