// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace pharos {
namespace {

// Below this squared angle (rad^2) the Taylor series to the fourth power is exact to double precision.
constexpr double kSmallAngleSquared = 1e-6;

struct Coefficients {
  double sin_over_angle;             // sin(a) / a
  double one_minus_cos_over_square;  // (1 - cos(a)) / a^2
};

Coefficients coefficients(double square) {
  if (square < kSmallAngleSquared) {
    return {1.0 - square / 6.0 + square * square / 120.0, 0.5 - square / 24.0 + square * square / 720.0};
  }
  const double angle = std::sqrt(square);
  return {std::sin(angle) / angle, (1.0 - std::cos(angle)) / square};
}

}  // namespace

Matrix3 rotation_exp(const Vector3& phi_rad) {
  const Coefficients c = coefficients(phi_rad.squaredNorm());
  const double x = phi_rad.x(), y = phi_rad.y(), z = phi_rad.z();
  const double sx = c.sin_over_angle * x, sy = c.sin_over_angle * y, sz = c.sin_over_angle * z;
  const double cx = c.one_minus_cos_over_square * x, cy = c.one_minus_cos_over_square * y,
               cz = c.one_minus_cos_over_square * z;
  Matrix3 R;
  R << 1.0 - (cz * z + cy * y), cy * x - sz, sy + cz * x,  //
      sz + cx * y, 1.0 - (cz * z + cx * x), cz * y - sx,   //
      cx * z - sy, sx + cy * z, 1.0 - (cy * y + cx * x);
  return R;
}

Vector3 rotation_log(const Matrix3& R) {
  const Quaternion q = canonical_quaternion(R);
  const Vector3 v = q.vec();
  const double sine_half = v.norm();
  // q = (cos(a/2), e sin(a/2)); for small angles a / sin(a/2) -> 2 (1 + s^2/6).
  const double scale =
      sine_half < 1e-4 ? 2.0 * (1.0 + sine_half * sine_half / 6.0) : 2.0 * std::atan2(sine_half, q.w()) / sine_half;
  return scale * v;
}

Matrix3 paper_rotation(const Vector3& phi_rad) { return rotation_exp(-phi_rad); }

Matrix3 paper_right_jacobian(const Vector3& phi_rad) {
  const double square = phi_rad.squaredNorm();
  const Coefficients c = coefficients(square);
  const double outer = square < kSmallAngleSquared ? 1.0 / 6.0 - square / 120.0 : (1.0 - c.sin_over_angle) / square;
  return c.sin_over_angle * Matrix3::Identity() + outer * phi_rad * phi_rad.transpose() -
         c.one_minus_cos_over_square * skew(phi_rad);
}

Quaternion canonical(const Quaternion& q) {
  const Quaternion unit = q.normalized();
  double sign = unit.w();
  for (int i = 0; i < 3 && sign == 0.0; ++i) sign = unit.vec()[i];
  return sign < 0.0 ? Quaternion(-unit.coeffs()) : unit;
}

Quaternion canonical_quaternion(const Matrix3& R) { return canonical(Quaternion(R)); }

double rotation_angle_between(const Matrix3& a, const Matrix3& b) { return rotation_log(a * b.transpose()).norm(); }

Matrix3 rotation_between(const Vector3& from, const Vector3& to) {
  const Vector3 a = from.normalized(), b = to.normalized();
  const Vector3 axis = a.cross(b);
  const double cosine = a.dot(b);
  // 1 + cos: near a half turn by the sine, without the rounding of the sum.
  const double sum = cosine > 0.0 ? 1.0 + cosine : axis.squaredNorm() / (1.0 - cosine);
  if (sum < 1e-15) {
    const Vector3 across = a.unitOrthogonal();
    return 2.0 * across * across.transpose() - Matrix3::Identity();
  }
  return cosine * Matrix3::Identity() + skew(axis) + axis * axis.transpose() / sum;
}

Matrix3 orthonormalised(const Matrix3& R) {
  Matrix3 result = R;
  for (int step = 0; step < 2; ++step) {
    result = 0.5 * result * (3.0 * Matrix3::Identity() - result.transpose() * result);
  }
  return result;
}

}  // namespace pharos
