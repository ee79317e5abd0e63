// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/network/station.hpp"

namespace pharos::network {

// Error of a body's state in the world: pose (rotation, position, as Pose::moved_by), rate, acceleration; 6 each.
inline constexpr Eigen::Index kStateSize = 18;
inline constexpr Eigen::Index kPoseAt = 0, kRateAt = 6, kAccelerationAt = 12;
using StateVector = Eigen::Matrix<double, kStateSize, 1>;
using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;

/// One Gaussian estimate of a body: means, and the covariance of their errors.
struct NetworkState {
  WorldFromBody pose;
  Vector6 rate = Vector6::Zero();          // rad/s, m/s, world frame
  Vector6 acceleration = Vector6::Zero();  // rad/s^2, m/s^2
  StateMatrix covariance = StateMatrix::Zero();

  /// The sum of its three components, m^2.
  double position_variance() const { return covariance.block<3, 3>(kPoseAt + 3, kPoseAt + 3).trace(); }
  /// Adds an error vector to the means.
  void move_by(const StateVector& delta);
  /// The error vector that takes `from` to this state.
  StateVector difference(const NetworkState& from) const;

  /// Constant acceleration under white jerk of these densities, (rad/s^3)^2 s and (m/s^3)^2 s. Steps of 20 ms at most.
  void predict(double dt_s, double jerk_rotation, double jerk_translation);
  /// A body at rest: rates are zero and known; the pose creeps.
  void predict_at_rest(double dt_s);
  /// Position, velocity and acceleration are these, with this covariance and none with the attitude.
  void place(const Vector3& position_m, const Vector3& velocity_m_s, const Vector3& acceleration_m_s2,
             const Eigen::Matrix<double, 9, 9>& position_covariance);
  /// Forgets rates and acceleration: zero, with these sigmas (rad/s, m/s, rad/s^2, m/s^2).
  void reset_rates(const std::array<double, 4>& sigmas);
};

}  // namespace pharos::network
