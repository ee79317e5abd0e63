// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/geometry/pose.hpp"

namespace pharos::motion {

struct SensorPlane;
struct SweepFit;

/// Sigmas between an attitude and the mirrored one up to which the tilt may be zero: it shows in its square, which is
/// known to 2 tilt sigma.
inline constexpr double kTiltMayBeZero = 8.0;

/// An attitude known better than this after a sweep makes the bearings' second order negligible.
inline constexpr double kLinear_rad = 0.003;

/// How coplanar sensors are tilted against the line of sight, and the pose in which they are tilted as much to the
/// other side: each sensor is in the same direction, and as far behind the plane across the line of sight as it was
/// before it. Bearings tell the two apart by perspective alone.
class Tilt {
 public:
  /// Of a body with this pose after the sweep, whose sensors' plane it is. Empty where they have relief, or are so few
  /// that any plane holds them.
  static std::optional<Tilt> of(const SweepFit& fit, const SensorPlane& plane, const LighthouseFromBody& pose);

  /// The rotation between the pose and the mirrored one: twice the tilt.
  double apart_rad() const { return apart_rad_; }
  /// That rotation over its standard deviation, squared.
  double apart_square(const Matrix3& attitude_covariance) const;
  /// What the covariance of a pose lacks, as the tilt shows in its square: known to 2 tilt sigma, the square leaves the
  /// tilt itself more than sigma towards zero, and the range takes the square of what the attitude is off by.
  Matrix6 second_order(const LighthouseFromBody& pose, const Matrix3& attitude_covariance) const;
  LighthouseFromBody mirrored(const LighthouseFromBody& pose) const;
  /// Derivative of the mirrored pose's error by the pose's; the same for rates.
  Matrix6 by_pose(const LighthouseFromBody& pose) const;

 private:
  Tilt(const LighthouseFromBody& pose, const Vector3& body_centre_m, const Vector3& body_normal);

  /// An attitude that is off by d across the line of sight makes the pattern of the sensors d.d/2 of its size smaller
  /// in one direction, in every sweep alike: a linear filter takes that for range, r d.d/2 at most. E (r d.d/2)^2 for
  /// d ~ N(0, A): r^2 (2 tr A^2 + (tr A)^2) / 4, m^2.
  double range_variance(const LighthouseFromBody& pose, const Matrix3& attitude_covariance) const;

  Vector3 sight_;          // to the sensors
  Matrix3 across_sight_;   // reflection at the plane across the line of sight
  Vector3 body_normal_;    // of the sensors' plane
  Vector3 body_centre_m_;  // of the sensors
  Vector3 axis_;           // of the rotation
  double apart_rad_ = 0.0;
};

}  // namespace pharos::motion
