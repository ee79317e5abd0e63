// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/paper.hpp"

#include <cmath>

namespace pharos::pose::paper {

Vector3 point(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m) {
  return paper_rotation(phi_rad) * body_m + t_m;
}

Vector2 residual(const Vector3& p, const Vector2& theta_rad) {
  return {p.x() / p.z() - 1.0 / std::tan(theta_rad.x()), p.y() / p.z() - 1.0 / std::tan(theta_rad.y())};
}

Matrix36 point_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& point_m) {
  Matrix36 jacobian;
  jacobian << skew(point_m - t_m) * paper_right_jacobian(phi_rad), Matrix3::Identity();
  return jacobian;
}

Matrix23 residual_by_point(const Vector3& p) {
  Matrix23 jacobian;
  jacobian << 1.0 / p.z(), 0.0, -p.x() / (p.z() * p.z()), 0.0, 1.0 / p.z(), -p.y() / (p.z() * p.z());
  return jacobian;
}

Matrix26 residual_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m) {
  const Vector3 p = point(phi_rad, t_m, body_m);
  return residual_by_point(p) * point_jacobian(phi_rad, t_m, p);
}

Matrix26 angle_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m) {
  const Vector3 p = point(phi_rad, t_m, body_m);
  const double square = p.z() * p.z();
  const Vector2 by_tangent(-square / (p.x() * p.x() + square), -square / (p.y() * p.y() + square));
  return by_tangent.asDiagonal() * residual_jacobian(phi_rad, t_m, body_m);
}

}  // namespace pharos::pose::paper
