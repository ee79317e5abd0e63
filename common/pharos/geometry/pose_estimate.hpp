// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "pharos/geometry/pose.hpp"

namespace pharos {

/// Difference in chi-squared below which a second minimum makes a pose ambiguous: 99 % for two degrees of freedom.
inline constexpr double kAmbiguousDeltaChi2 = 9.21;

/// A second pose that fits nearly as well, and the difference in chi-squared.
template <class Parent, class Child>
struct SecondSolution {
  Pose<Parent, Child> pose;
  double delta_chi2 = 0.0;
};

/// The result of every measuring path of Pharos: a pose with its time, its uncertainty and its second solution.
template <class Parent, class Child>
struct PoseEstimate {
  /// Time of validity on the source's own clock, nanoseconds (for the lighthouse: unwrapped ticks x 20).
  std::int64_t time_ns = 0;
  Pose<Parent, Child> pose;
  /// Of the error delta in R_true = exp([delta]x) R_est (rad) before translation (m), in Parent.
  Matrix6 covariance = Matrix6::Zero();
  /// Root mean square of the residuals of single observations; rad for angles.
  double residual_rms = 0.0;
  /// Single observations used (angles, not sensors).
  int observations = 0;
  int iterations = 0;
  /// Attitude and position dilution of precision, paper 002 equation (22): degrees and metres per rad of bearing noise.
  double adop_deg_per_rad = 0.0;
  double pdop_m_per_rad = 0.0;
  /// Present exactly when a second minimum lies within kAmbiguousDeltaChi2 of this one.
  std::optional<SecondSolution<Parent, Child>> second;

  bool ambiguous() const { return second.has_value(); }
  /// Square root of the trace of the rotation block, rad; equals (24) when the covariance is H sigma^2.
  double sigma_rotation_rad() const { return std::sqrt(covariance.template topLeftCorner<3, 3>().trace()); }
  /// Square root of the trace of the translation block, m.
  double sigma_position_m() const { return std::sqrt(covariance.template bottomRightCorner<3, 3>().trace()); }
};

using LighthousePoseEstimate = PoseEstimate<frame::Lighthouse, frame::Body>;

}  // namespace pharos
