// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/axis_plane.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pointing/tangent.hpp"

namespace pharos::pointing {

double AxisPlane::sigma_rad(const Vector3& direction) const {
  return std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
}

double AxisPlane::worst_sigma_rad() const {
  const Tangent axes = tangent_of(normal);
  const double uu = axes.first.dot(covariance * axes.first);
  const double vv = axes.second.dot(covariance * axes.second);
  const double uv = axes.first.dot(covariance * axes.second);
  return std::sqrt(std::max(0.0, 0.5 * (uu + vv) + std::hypot(0.5 * (uu - vv), uv)));
}

AxisPlane rotated(const AxisPlane& plane, const Matrix3& R) {
  return {R * plane.normal, R * plane.covariance * R.transpose()};
}

AxisPlane plane_of_line(const ImageLine& line, const PinholeCamera& camera) {
  Matrix3 K;
  K << camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0;
  const Vector3 n = K.transpose() * line.coefficients;
  const double length = n.norm();
  const Vector3 normal = n / length;
  const Matrix3 across = (Matrix3::Identity() - normal * normal.transpose()) / length;
  const Matrix3 jacobian = across * K.transpose();
  return {normal, jacobian * line.covariance * jacobian.transpose()};
}

}  // namespace pharos::pointing
