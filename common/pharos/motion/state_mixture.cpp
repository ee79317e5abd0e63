// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/state_mixture.hpp"

#include "pharos/geometry/small_difference.hpp"

namespace pharos::motion {
namespace {

[[gnu::flatten]] void blend_block(Matrix6& into, const Matrix6& other, double weight, const Vector6& left,
                                  const Vector6& right) {
  into += weight * (other - into) + (weight * (1.0 - weight) * left).lazyProduct(right.transpose());
}

// What the moments of the second station's pose become; `p`: how far apart the poses are.
Vector6 blend_station(SecondStation& into, const SecondStation& other, double weight, const Vector6& p) {
  const Vector6 s = small_difference(other.pose, into.pose);
  blend_block(into.ss, other.ss, weight, s, s);
  blend_block(into.sp, other.sp, weight, s, p);
  into.pose = into.pose.moved_by(weight * s);
  return s;
}

}  // namespace

void blend(RestingState& into, const MovingState& other, double weight, bool linked) {
  const Vector6 p = small_difference(other.pose, into.pose);
  blend_block(into.covariance, other.pp, weight, p, p);
  if (linked) blend_station(into.second, other.second, weight, p);
  into.pose = into.pose.moved_by(weight * p);
}

void blend(MovingState& into, const MovingState& other, double weight, bool linked) {
  const Vector6 p = small_difference(other.pose, into.pose);
  const Vector6 r = other.rate - into.rate, a = other.acceleration - into.acceleration;
  blend_block(into.pp, other.pp, weight, p, p);
  blend_block(into.rp, other.rp, weight, r, p);
  blend_block(into.rr, other.rr, weight, r, r);
  blend_block(into.ap, other.ap, weight, a, p);
  blend_block(into.ar, other.ar, weight, a, r);
  blend_block(into.aa, other.aa, weight, a, a);
  if (linked) {
    const Vector6 s = blend_station(into.second, other.second, weight, p);
    blend_block(into.second.sr, other.second.sr, weight, s, r);
    blend_block(into.second.sa, other.second.sa, weight, s, a);
  }
  into.pose = into.pose.moved_by(weight * p);
  into.rate += weight * r;
  into.acceleration += weight * a;
}

}  // namespace pharos::motion
