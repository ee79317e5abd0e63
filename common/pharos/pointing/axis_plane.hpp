// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "pharos/base/static_vector.hpp"
#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::pointing {

/// A plane through the camera's centre that contains the direction of an edge: n . d = 0 for the edge's direction d.
/// The variable's name gives the frame of the normal (_camera, _station, ...).
struct AxisPlane {
  Vector3 normal = Vector3::Zero();  ///< unit; its sign means nothing
  /// Of the normal, rad^2: zero along the normal itself.
  Matrix3 covariance = Matrix3::Zero();

  /// Standard deviation, rad, of the angle by which `direction` (unit) leaves the plane.
  double sigma_rad(const Vector3& direction) const;
  /// The same for the direction in the plane with the largest one.
  double worst_sigma_rad() const;
};

/// The same plane in another frame: R maps vectors of the present frame to that one.
AxisPlane rotated(const AxisPlane& plane, const Matrix3& R);

/// A straight line a u + b v + c = 0 of the ideal image, pixels; a^2 + b^2 = 1.
struct ImageLine {
  Vector3 coefficients = Vector3::Zero();
  Matrix3 covariance = Matrix3::Zero();
};

/// Paper 003 (9) and (10): n = K^T (a, b, c) in frame C, scaled to length 1, with its covariance. Precondition: (a, b)
/// is not zero. Distortion does not enter: the line is one of the ideal image.
AxisPlane plane_of_line(const ImageLine& line, const PinholeCamera& camera);

/// Maximum edges of one image that are used together: four of each of two panels.
inline constexpr std::size_t kMaxEdges = 8;
using AxisPlanes = StaticVector<AxisPlane, kMaxEdges>;

}  // namespace pharos::pointing
