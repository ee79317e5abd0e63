// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"

namespace pharos {

/// pose_difference() of poses that are near each other: the rotation to first order, without an arc cosine.
template <class Parent, class Child>
Vector6 small_difference(const Pose<Parent, Child>& to, const Pose<Parent, Child>& from) {
  const Matrix3 turn = to.R.lazyProduct(from.R.transpose());
  Vector6 delta;
  delta << 0.5 * (turn(2, 1) - turn(1, 2)), 0.5 * (turn(0, 2) - turn(2, 0)), 0.5 * (turn(1, 0) - turn(0, 1)),
      to.t - from.t;
  return delta;
}

}  // namespace pharos
