// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/pointing/axis_plane.hpp"

namespace pharos::pointing {

using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Row5 = Eigen::Matrix<double, 1, 5>;

/// A panel axis that rotates steadily about a fixed direction: d(t) = exp([spin]x rate t) axis. All in one inertial
/// frame.
struct Spin {
  Vector3 axis = Vector3::UnitX();  ///< unit, of the panel, at t = 0; its sign is open
  Vector3 spin = Vector3::UnitZ();  ///< unit; (spin, rate) and (-spin, -rate) are the same
  double rate_rad_s = 0.0;

  Vector3 at(double seconds) const;
  /// Moved by (axis along its two tangent directions, spin along its two, rate): the parameters of every covariance
  /// here; rad, rad, rad, rad, rad/s. Tangent directions are those of tangent_of.
  Spin moved_by(const Eigen::Matrix<double, 5, 1>& delta) const;
};

/// d (normal . d(t)) / d (the five of Spin::moved_by).
Row5 spin_jacobian(const Spin& spin, const Vector3& normal, double seconds);

struct SpinEstimate {
  Spin spin;
  Matrix5 covariance = Matrix5::Zero();
  Matrix3 axis_covariance = Matrix3::Zero();
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  /// Another motion with another axis at t = 0 that fits nearly as well (delta chi2 < 9.21).
  std::optional<Spin> second;
  double second_delta_chi2 = 0.0;
};

enum class SpinFailure : std::uint8_t {
  kTooFewPlanes,  // five unknowns: fewer than eight planes allow no test
  kNotSeen,       // a fixed axis fits as well, or rate and spin axis are not determined
};

inline constexpr std::size_t kMinSpinPlanes = 8;

/// Least squares over axis, spin axis and rate from a search over all spin axes and rates up to `max_rate_rad_s`
/// (either way). Planes are of an inertial frame, `seconds` their times. Cost: some 1e8 floating-point operations.
Result<SpinEstimate, SpinFailure> fit_spin(std::span<const AxisPlane> planes, std::span<const double> seconds,
                                           double max_rate_rad_s);

}  // namespace pharos::pointing
