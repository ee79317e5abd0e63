// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/motion/kinematic_state.hpp"

namespace pharos::motion {

/// Error of a pose that is near another one, as Pose::moved_by: the rotation to first order.
template <class Parent, class Child>
Vector6 small_difference(const Pose<Parent, Child>& to, const Pose<Parent, Child>& from) {
  const Matrix3 turn = to.R.lazyProduct(from.R.transpose());
  Vector6 delta;
  delta << 0.5 * (turn(2, 1) - turn(1, 2)), 0.5 * (turn(0, 2) - turn(2, 0)), 0.5 * (turn(1, 0) - turn(0, 1)),
      to.t - from.t;
  return delta;
}

/// Moments of a mixture of two estimates, the second with the fraction `weight`. `linked`: with the pose of a second
/// station.
void blend(RestingState& into, const MovingState& other, double weight, bool linked);
void blend(MovingState& into, const MovingState& other, double weight, bool linked);

}  // namespace pharos::motion
