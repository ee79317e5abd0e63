// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/settings.hpp"

namespace pharos::fusion {

/// Pose of the target in the vehicle frame, and its rates in that frame (relative to the vehicle).
struct Kinematics {
  TargetPose pose;
  Vector3 rate_rad_s = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
};

/// Derivatives of one step: errors of rotation, position, rate and velocity after it by those before it. Attitude and
/// position are independent of each other.
struct Transition {
  Matrix3 rotation_rotation, rotation_rate, rate_rotation, rate_rate;
  Matrix3 position_position, position_velocity, velocity_position, velocity_velocity;

  /// The twelve errors (rotation, position, rate, velocity) after the step.
  void apply(double* errors) const;
};

/// Whether the attitude follows Euler's equations with the inertia ratios that were told.
bool tumbles(const MotionSettings& motion);

/// Spectral density of the white angular acceleration, (rad/s^2)^2 s. What a body's own turning causes, sigma = ratio
/// rate^2, lasts as long as a radian of that turning: white noise of density 2 sigma^2 / rate has the same effect over
/// longer times.
double angular_density(double rate_rad_s, const MotionSettings& motion);

/// Steps longer than this are divided: the attitude's derivatives are of first order in rate times step.
inline constexpr double kMaxStep_s = 0.05;

/// Moves the state by dt_s <= kMaxStep_s (negative is allowed).
///
/// Attitude: R <- exp(omega dt) R; torque-free rotation by Euler's equations, J w' = -w x J w in principal axes, of the
/// rate relative to inertial space (midpoint rule). Position: constant velocity, or the closed solution of Clohessy and
/// Wiltshire, "Terminal guidance system for satellite rendezvous", J. Aerospace Sci. 27 (1960).
Transition advance(Kinematics& state, double dt_s, const MotionSettings& motion);

}  // namespace pharos::fusion
