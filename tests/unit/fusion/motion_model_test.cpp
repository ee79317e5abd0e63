// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/motion_model.hpp"

#include <gtest/gtest.h>

namespace pharos::fusion {
namespace {

Kinematics some_state() {
  Kinematics state;
  state.pose = {rotation_exp(Vector3(0.4, -0.8, 0.3)), {3.0, -20.0, 5.0}};
  state.rate_rad_s = Vector3(0.05, -0.03, 0.08);
  state.velocity_m_s = Vector3(0.02, 0.05, -0.01);
  return state;
}

MotionSettings in_orbit(MotionKind kind) {
  MotionSettings motion;
  motion.kind = kind;
  motion.mean_motion_rad_s = 0.0011;
  motion.R_vehicle_orbit = rotation_exp(Vector3(0.2, 0.1, -0.5));
  motion.inertia_ratios = Vector3(1.0, 1.4, 1.8);
  motion.R_target_principal = rotation_exp(Vector3(0.1, 0.7, 0.2));
  return motion;
}

Eigen::Matrix<double, 12, 1> difference(const Kinematics& a, const Kinematics& b) {
  Eigen::Matrix<double, 12, 1> d;
  d << pose_difference(a.pose, b.pose), a.rate_rad_s - b.rate_rad_s, a.velocity_m_s - b.velocity_m_s;
  return d;
}

Kinematics moved(const Kinematics& from, const Eigen::Matrix<double, 12, 1>& d) {
  Kinematics out = from;
  out.pose = from.pose.moved_by(d.head<6>());
  out.rate_rad_s += d.segment<3>(6);
  out.velocity_m_s += d.tail<3>();
  return out;
}

TEST(MotionModel, TransitionIsTheDerivativeOfTheStep) {
  for (const MotionKind kind :
       {MotionKind::kFree, MotionKind::kClohessyWiltshire, MotionKind::kTumbling, MotionKind::kTumblingInOrbit}) {
    const MotionSettings motion = in_orbit(kind);
    Kinematics after = some_state();
    const Transition transition = advance(after, 0.02, motion);
    for (int axis = 0; axis < 12; ++axis) {
      constexpr double kStep = 1e-5;
      const Eigen::Matrix<double, 12, 1> unit = Eigen::Matrix<double, 12, 1>::Unit(axis);
      Kinematics plus = moved(some_state(), unit * kStep);
      Kinematics minus = moved(some_state(), -unit * kStep);
      advance(plus, 0.02, motion);
      advance(minus, 0.02, motion);
      const Eigen::Matrix<double, 12, 1> numeric = difference(plus, minus) / (2.0 * kStep);
      Eigen::Matrix<double, 12, 1> analytic = unit;
      transition.apply(analytic.data());
      // First order in rate times step: 0.1 rad/s over 0.02 s.
      EXPECT_LT((numeric - analytic).norm(), 3e-5) << "axis " << axis << " kind " << static_cast<int>(kind);
    }
  }
}

// The differential equations of Clohessy and Wiltshire, integrated in small steps.
TEST(MotionModel, FollowsTheOrbitalEquations) {
  MotionSettings motion = in_orbit(MotionKind::kClohessyWiltshire);
  motion.R_vehicle_orbit.setIdentity();
  Kinematics state = some_state();
  Vector3 r = state.pose.t;
  Vector3 v = state.velocity_m_s;
  const double n = motion.mean_motion_rad_s;
  constexpr double kStep_s = 0.01;
  for (int k = 0; k < 60000; ++k) {
    const auto acceleration = [n](const Vector3& p, const Vector3& u) {
      return Vector3(3 * n * n * p.x() + 2 * n * u.y(), -2 * n * u.x(), -n * n * p.z());
    };
    const Vector3 half_v = v + 0.5 * kStep_s * acceleration(r, v);
    const Vector3 half_r = r + 0.5 * kStep_s * v;
    r += kStep_s * half_v;
    v += kStep_s * acceleration(half_r, half_v);
    if (k % 5 == 0) advance(state, 5 * kStep_s, motion);
  }
  EXPECT_LT((state.pose.t - r).norm(), 1e-4);
  EXPECT_LT((state.velocity_m_s - v).norm(), 1e-6);
}

TEST(MotionModel, TumblingKeepsAngularMomentumAndEnergy) {
  const MotionSettings motion = in_orbit(MotionKind::kTumbling);
  Kinematics state = some_state();
  const auto momentum = [&] {
    const Matrix3 R = state.pose.R * motion.R_target_principal;
    return Vector3(R * motion.inertia_ratios.asDiagonal() * R.transpose() * state.rate_rad_s);
  };
  const Vector3 before = momentum();
  const double energy = before.dot(state.rate_rad_s);
  const Vector3 rate = state.rate_rad_s;
  for (int k = 0; k < 3000; ++k) advance(state, 0.02, motion);
  EXPECT_LT((momentum() - before).norm(), 1e-5 * before.norm());
  EXPECT_NEAR(momentum().dot(state.rate_rad_s), energy, 1e-5 * energy);
  EXPECT_GT((state.rate_rad_s - rate).norm(), 0.01);  // it does tumble
}

TEST(MotionModel, AStepBackUndoesTheStep) {
  for (const MotionKind kind : {MotionKind::kFree, MotionKind::kClohessyWiltshire}) {
    Kinematics state = some_state();
    advance(state, 0.03, in_orbit(kind));
    advance(state, -0.03, in_orbit(kind));
    EXPECT_LT(difference(state, some_state()).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace pharos::fusion
