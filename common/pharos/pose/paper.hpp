// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/rotation.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::pose::paper {

// Equations (2)-(13) of paper 002 as printed, in its own unknowns psi = (phi, t): the reference that the solver's
// left-error Jacobians are tested against. R(phi) of (5) is passive, exp(-[phi]x), and (8) and (9) hold with it.

using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

/// (3): the sensor in the lighthouse frame, m.
Vector3 point(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m);
/// (6): (x/z - cot theta_x, y/z - cot theta_y).
Vector2 residual(const Vector3& point_m, const Vector2& theta_rad);
/// (8): d p / d psi = [(p - t)x J_r(phi), I].
Matrix36 point_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& point_m);
/// (10): d f / d p.
Matrix23 residual_by_point(const Vector3& point_m);
/// (11): d f / d psi.
Matrix26 residual_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m);
/// (13): d theta / d psi.
Matrix26 angle_jacobian(const Vector3& phi_rad, const Vector3& t_m, const Vector3& body_m);

}  // namespace pharos::pose::paper
