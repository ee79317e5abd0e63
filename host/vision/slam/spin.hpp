// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/slam/tracked_frame.hpp"

namespace pharos::slam {

/// A target's constant angular velocity in the camera's frame.
struct Spin {
  Vector3 rate_rad_s = Vector3::Zero();
  Matrix3 covariance = Matrix3::Zero();  ///< of the rate, (rad/s)^2
  double residual_rms_rad = 0.0;         ///< of single attitudes around the fit
  double turned_rad = 0.0;               ///< between first and last frame
  int frames = 0;

  double rate() const { return rate_rad_s.norm(); }
  Vector3 axis() const { return rate_rad_s.normalized(); }
  /// 1 sigma of the axis' direction, about the worst perpendicular, rad; of the rate along the axis, rad/s.
  double sigma_axis_rad() const;
  double sigma_rate_rad_s() const;
};

/// R(t) = exp(w (t - mean t)) R_mean, fitted to all attitudes by least squares over w and R_mean. Errors of
/// neighbouring attitudes are correlated: the covariance uses the effective number of independent ones, from the
/// residuals' correlation. Empty below ten frames.
std::optional<Spin> fit_spin(const std::vector<TrackedFrame>& frames);

/// Of attitudes that an adjustment put on a rotation at this rate, whose scatter says nothing: the rate with the
/// covariance of `fit`, to the attitudes without that, and the square of the difference.
Spin steady_spin(const Vector3& rate_rad_s, const Spin& fit);

}  // namespace pharos::slam
