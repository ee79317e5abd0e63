// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/frames.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos {

/// T_parent_child: maps coordinates in Child to Parent, p_parent = R p_child + t. Metres.
///
/// The frames are types, so `T_a_b * T_c_d` compiles only when b is c.
template <class Parent, class Child>
struct Pose {
  Matrix3 R = Matrix3::Identity();
  Vector3 t = Vector3::Zero();

  /// Coordinates in Parent of a point given in Child.
  Vector3 operator*(const Vector3& p_child) const { return R * p_child + t; }
  Pose<Child, Parent> inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  Quaternion quaternion() const { return canonical_quaternion(R); }
  bool is_finite() const { return R.allFinite() && t.allFinite(); }

  /// This pose moved by an error delta (rotation vector rad before translation m, in Parent):
  /// R' = exp([delta_rot]x) R, t' = t + delta_trans. The error that every 6x6 covariance of Pharos describes.
  Pose moved_by(const Vector6& delta) const {
    return {rotation_exp(delta.template head<3>()) * R, t + delta.template tail<3>()};
  }
};

template <class A, class B, class C>
Pose<A, C> operator*(const Pose<A, B>& T_a_b, const Pose<B, C>& T_b_c) {
  return {T_a_b.R * T_b_c.R, T_a_b.R * T_b_c.t + T_a_b.t};
}

/// The delta of moved_by that maps `from` to `to`: R_to = exp([delta_rot]x) R_from, t_to = t_from + delta_trans.
template <class Parent, class Child>
Vector6 pose_difference(const Pose<Parent, Child>& to, const Pose<Parent, Child>& from) {
  Vector6 delta;
  delta << rotation_log(to.R * from.R.transpose()), to.t - from.t;
  return delta;
}

using LighthouseFromBody = Pose<frame::Lighthouse, frame::Body>;

}  // namespace pharos
