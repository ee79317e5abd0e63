// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/motion_model.hpp"

#include <cmath>

namespace pharos::fusion {
namespace {

bool orbits(const MotionSettings& m) {
  return m.kind == MotionKind::kClohessyWiltshire || m.kind == MotionKind::kTumblingInOrbit;
}

// Left Jacobian of the rotation vector, third order: exact to |phi|^3 / 24.
Matrix3 left_jacobian(const Vector3& phi) {
  const Matrix3 x = skew(phi);
  return Matrix3::Identity() + 0.5 * x + x * x / 6.0;
}

struct AngularAcceleration {
  Vector3 value;  // of the rate relative to the vehicle
  Matrix3 by_rate, by_rotation;
};

// In the vehicle frame, which turns with the orbit: alpha = R J^-1 (-w x J w) - Omega x omega, w = R^T omega and omega
// the inertial rate. Its derivative by the attitude follows from alpha(exp(d) R, omega) = exp(d) alpha(R, exp(-d)
// omega).
AngularAcceleration torque_free(const Matrix3& R_vehicle_target, const Vector3& rate, const MotionSettings& m) {
  const Vector3 orbit_rate =
      orbits(m) ? Vector3(m.R_vehicle_orbit.col(2) * m.mean_motion_rad_s) : Vector3(Vector3::Zero());
  const Matrix3 R = R_vehicle_target * m.R_target_principal;
  const Vector3 inertial = rate + orbit_rate;
  const Vector3 w = R.transpose() * inertial;
  const Vector3 momentum = m.inertia_ratios.cwiseProduct(w);
  const Vector3 inverse = m.inertia_ratios.cwiseInverse();
  const Vector3 alpha = R * inverse.cwiseProduct(momentum.cross(w));
  const Matrix3 slope = inverse.asDiagonal() * (skew(momentum) - skew(w) * m.inertia_ratios.asDiagonal());
  const Matrix3 by_inertial = R * slope * R.transpose();
  return {alpha - orbit_rate.cross(inertial), by_inertial - skew(orbit_rate),
          by_inertial * skew(inertial) - skew(alpha)};
}

void rotate_freely(Kinematics& state, double dt, Transition& t) {
  const Vector3 phi = state.rate_rad_s * dt;
  t.rotation_rotation = rotation_exp(phi);
  t.rotation_rate = left_jacobian(phi) * dt;
  t.rate_rotation.setZero();
  t.rate_rate.setIdentity();
  state.pose.R = orthonormalised(t.rotation_rotation * state.pose.R);
}

void tumble(Kinematics& state, double dt, const MotionSettings& m, Transition& t) {
  const AngularAcceleration start = torque_free(state.pose.R, state.rate_rad_s, m);
  const Vector3 middle_rate = state.rate_rad_s + 0.5 * dt * start.value;
  const Matrix3 middle = rotation_exp(0.5 * dt * state.rate_rad_s) * state.pose.R;
  const AngularAcceleration half = torque_free(middle, middle_rate, m);
  const Vector3 phi = middle_rate * dt;
  t.rotation_rotation = rotation_exp(phi);
  t.rotation_rate = left_jacobian(phi) * dt;
  t.rate_rotation = half.by_rotation * dt;
  t.rate_rate = Matrix3::Identity() + half.by_rate * dt;
  state.pose.R = orthonormalised(t.rotation_rotation * state.pose.R);
  state.rate_rad_s += half.value * dt;
}

void move_freely(Kinematics& state, double dt, Transition& t) {
  t.position_position.setIdentity();
  t.position_velocity = Matrix3::Identity() * dt;
  t.velocity_position.setZero();
  t.velocity_velocity.setIdentity();
  state.pose.t += state.velocity_m_s * dt;
}

void move_in_orbit(Kinematics& state, double dt, const MotionSettings& m, Transition& t) {
  const double n = m.mean_motion_rad_s;
  const double s = std::sin(n * dt);
  const double half = std::sin(0.5 * n * dt);
  const double versine = 2.0 * half * half;  // 1 - cos
  const double c = 1.0 - versine;
  Matrix3 rr, rv, vr, vv;
  rr << 1.0 + 3.0 * versine, 0, 0, 6.0 * (s - n * dt), 1, 0, 0, 0, c;
  rv << s / n, 2.0 * versine / n, 0, -2.0 * versine / n, (4.0 * s - 3.0 * n * dt) / n, 0, 0, 0, s / n;
  vr << 3.0 * n * s, 0, 0, -6.0 * n * versine, 0, 0, 0, 0, -n * s;
  vv << c, 2.0 * s, 0, -2.0 * s, 4.0 * c - 3.0, 0, 0, 0, c;
  const Matrix3& R = m.R_vehicle_orbit;
  t.position_position = R * rr * R.transpose();
  t.position_velocity = R * rv * R.transpose();
  t.velocity_position = R * vr * R.transpose();
  t.velocity_velocity = R * vv * R.transpose();
  const Vector3 position = state.pose.t;
  state.pose.t = t.position_position * position + t.position_velocity * state.velocity_m_s;
  state.velocity_m_s = t.velocity_position * position + t.velocity_velocity * state.velocity_m_s;
}

}  // namespace

bool tumbles(const MotionSettings& motion) {
  return motion.kind == MotionKind::kTumbling || motion.kind == MotionKind::kTumblingInOrbit;
}

double angular_density(double rate_rad_s, const MotionSettings& motion) {
  if (tumbles(motion)) return motion.angular_acceleration_density;
  const double ratio = motion.gyroscopic_ratio;
  return motion.angular_acceleration_density + 2.0 * ratio * ratio * rate_rad_s * rate_rad_s * rate_rad_s;
}

void Transition::apply(double* errors) const {
  Eigen::Map<Vector3> rotation(errors), position(errors + 3), rate(errors + 6), velocity(errors + 9);
  const Vector3 rotation_after = rotation_rotation * rotation + rotation_rate * rate;
  rate = rate_rotation * rotation + rate_rate * rate.eval();
  rotation = rotation_after;
  const Vector3 position_after = position_position * position + position_velocity * velocity;
  velocity = velocity_position * position + velocity_velocity * velocity.eval();
  position = position_after;
}

Transition advance(Kinematics& state, double dt_s, const MotionSettings& motion) {
  Transition t;
  if (tumbles(motion)) {
    tumble(state, dt_s, motion, t);
  } else {
    rotate_freely(state, dt_s, t);
  }
  if (orbits(motion)) {
    move_in_orbit(state, dt_s, motion, t);
  } else {
    move_freely(state, dt_s, t);
  }
  return t;
}

}  // namespace pharos::fusion
