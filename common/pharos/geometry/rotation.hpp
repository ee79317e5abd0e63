// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos {

/// Cross-product matrix: skew(a) b = a x b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// exp([phi]x), the active rotation by |phi| rad about phi. Accurate down to phi = 0.
Matrix3 rotation_exp(const Vector3& phi_rad);

/// Rotation vector of R, |phi| in [0, pi] rad; inverse of rotation_exp, accurate near 0 and near pi.
Vector3 rotation_log(const Matrix3& R);

/// The paper's R(phi) (002, equation 5): passive convention, equal to rotation_exp(-phi).
Matrix3 paper_rotation(const Vector3& phi_rad);

/// The paper's J_r(phi) (002, equation 9): sin|phi|/|phi| I + (1 - sin|phi|/|phi|) e e^T + (cos|phi| - 1)/|phi| [e]x.
Matrix3 paper_right_jacobian(const Vector3& phi_rad);

/// Unit quaternion of R with w >= 0 (where w = 0: first non-zero of x, y, z positive).
Quaternion canonical_quaternion(const Matrix3& R);
/// The same rotation's representative with w >= 0, scaled to unit length.
Quaternion canonical(const Quaternion& q);

/// Angle in rad, [0, pi], of the rotation from b to a.
double rotation_angle_between(const Matrix3& a, const Matrix3& b);

/// The smallest rotation that turns `from` to the direction of `to`; of opposite ones, a half turn about one of the
/// axes across them. Neither is zero.
Matrix3 rotation_between(const Vector3& from, const Vector3& to);

/// Nearest rotation to R in the Frobenius sense when R is already nearly one (two Newton steps of the polar
/// decomposition); keeps long chains of products orthonormal.
Matrix3 orthonormalised(const Matrix3& R);

}  // namespace pharos
