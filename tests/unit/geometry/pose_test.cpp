// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace pharos {
namespace {

using LighthouseFromVehicle = Pose<frame::Lighthouse, frame::Vehicle>;
using VehicleFromBody = Pose<frame::Vehicle, frame::Body>;

template <class A, class B>
concept Composes = requires(A a, B b) {
  a* b;
};

TEST(Pose, ComposesOnlyWhereInnerFramesMatch) {
  static_assert(std::is_same_v<decltype(LighthouseFromVehicle{} * VehicleFromBody{}), LighthouseFromBody>);
  static_assert(!Composes<VehicleFromBody, LighthouseFromVehicle>);
}

TEST(Pose, CompositionActsAsOneAfterTheOther) {
  const LighthouseFromVehicle T_l_v{rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  const VehicleFromBody T_v_b{rotation_exp({-1.0, 0.4, 0.2}), {-0.3, 0.1, 5}};
  const Vector3 p_body(0.2, -0.4, 0.7);
  EXPECT_NEAR(((T_l_v * T_v_b) * p_body - T_l_v * (T_v_b * p_body)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((T_l_v.inverse() * (T_l_v * p_body) - p_body).norm(), 0.0, 1e-14);
}

TEST(Pose, DifferenceUndoesMovedBy) {
  const LighthouseFromBody pose{rotation_exp({0.5, -1.2, 2.0}), {0.4, -0.1, 3.0}};
  Vector6 delta;
  delta << 0.01, -0.02, 0.03, 0.1, 0.2, -0.3;
  EXPECT_NEAR((pose_difference(pose.moved_by(delta), pose) - delta).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace pharos
