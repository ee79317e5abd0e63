// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/geometry/rotation.hpp"

namespace pharos::slam {

/// d log(exp(phi + d) exp(-phi)) / d d, phi in rad.
inline Matrix3 left_jacobian(const Vector3& phi) {
  const double angle = phi.norm();
  const Matrix3 cross = skew(phi);
  if (angle < 1e-6) return Matrix3::Identity() + 0.5 * cross;
  return Matrix3::Identity() + (1.0 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

}  // namespace pharos::slam
