// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/pointing/axis_plane.hpp"

namespace pharos::pointing {

/// The direction that several planes have in common.
struct AxisEstimate {
  Vector3 axis = Vector3::UnitZ();  ///< unit, its sign open
  /// Of the axis, rad^2: zero along the axis itself. Along the common plane it grows to that of "any direction in the
  /// plane" (52 deg, 180 / sqrt 12); linearising an ill-conditioned system does not make it too small.
  Matrix3 covariance = Matrix3::Zero();
  /// Determined even by parallel planes: one plane that contains the axis.
  AxisPlane plane;
  /// Sigma, rad, of the angle between axis and that plane: the largest of any direction within 2 sigma of the axis.
  double sigma_plane_rad = 0.0;
  /// Sigma of the axis along the plane, rad.
  double sigma_along_rad = 0.0;
  double chi2 = 0.0;
  int degrees_of_freedom = 0;

  double sigma_rad() const;
};

enum class AxisFailure : std::uint8_t {
  kTooFewPlanes,  // one plane alone: any direction in it
  kNotFinite,     // a normal that is not a unit vector, or an invalid covariance
};
const char* name_of(AxisFailure failure);

/// Plane-plane intersection (paper 003, (11)-(12): n1 x n2) for two planes and more, each with its covariance.
///
/// Minimises chi2(d) = sum (n_i . d)^2 / (d^T Sigma_i d). For two planes the minimum is n1 x n2 exactly. Where the
/// planes are so nearly one that n1 x n2 is not much longer than its noise, the result is the mean over the directions
/// of the common plane, each weighted by exp(-chi2 / 2), with a uniform prior over directions; its covariance is that
/// mean's. Cost: a few dozen steps of 3x3 for good geometry, 2000 evaluations of chi2 for bad one.
Result<AxisEstimate, AxisFailure> estimate_axis(std::span<const AxisPlane> planes);

/// d (n1 x n2 scaled to length 1) / d (n1, n2), two 3x3 blocks: propagates the covariance of two planes.
struct IntersectionJacobian {
  Matrix3 by_first, by_second;
};
IntersectionJacobian intersection_jacobian(const Vector3& first, const Vector3& second);

}  // namespace pharos::pointing
