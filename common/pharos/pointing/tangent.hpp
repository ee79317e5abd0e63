// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/geometry/types.hpp"

namespace pharos::pointing {

/// Two unit vectors that with `direction` (unit) make a right-handed triad.
struct Tangent {
  Vector3 first, second;
};

inline Tangent tangent_of(const Vector3& direction) {
  // The coordinate axis farthest from it: never parallel.
  Eigen::Index minimum = 0;
  direction.cwiseAbs().minCoeff(&minimum);
  const Vector3 first = direction.cross(Vector3(Vector3::Unit(minimum))).normalized();
  return {first, direction.cross(first)};
}

}  // namespace pharos::pointing
