// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/geometry/target.hpp"
#include "pharos/network/network_state.hpp"
#include "pharos/network/recent_sweeps.hpp"

namespace pharos::network {

/// Errors of position, velocity, acceleration: 3 each.
using FixMatrix = Eigen::Matrix<double, 9, 9>;

/// A plane whose sweeps a position was found from.
struct FixPlane {
  std::size_t station = 0;
  std::size_t plane = 0;
  double time_s = 0.0;                 // of the last one
  Vector3 gradient = Vector3::Zero();  // of its angle by the position then, rad/m
};
using FixPlanes = StaticVector<FixPlane, kPlanes * kMaxNetworkStations>;

/// Where a body is and how it moves, from the recent sweeps alone.
struct PositionFix {
  Vector3 position_m = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
  Vector3 acceleration_m_s2 = Vector3::Zero();
  FixMatrix covariance = FixMatrix::Zero();  // of noise and motion; what stations are wrong by is beside it
  // All sweeps agree, and there are at least four of each of two stations: three each are explained by a position and a
  // velocity, whatever a reflection makes of one.
  bool sound = false;
  // Without the one sweep that moves it most it would be off by this much: that one may be a reflection.
  Eigen::Matrix<double, 9, 1> by_one = Eigen::Matrix<double, 9, 1>::Zero();
  Matrix3 far_m2 = Matrix3::Zero();  // how far off sweeps say that do not fit, outer products
  FixPlanes planes;

  Matrix3 doubted_covariance() const;
  Matrix3 position_covariance() const { return covariance.topLeftCorner<3, 3>(); }
};

/// Position, velocity and acceleration at `now_s`, not before any of the sweeps, attitude and its rate taken from
/// `near`, where at least two stations saw the body with both planes within the last 70 ms: robust least squares of the
/// sweeps' mean angles, each at its own instant, the more the older the less. Priors: 4 m/s, 20 m/s^2, 500 m/s^3.
/// `turn_rad`: what the attitude may be off by beside its covariance, about each axis: the mean of some of the sensors
/// is elsewhere then. Empty where it does not converge, or where some plane's last sweep departs by more than 15 mrad.
///
/// Cost: a 9x9 solution a step, some 10 us on a host.
std::optional<PositionFix> fix_of(const SweepView& recent, const Stations& stations, const Target& target,
                                  const NetworkState& near, double now_s, const HitNoise& noise, double turn_rad);

}  // namespace pharos::network
