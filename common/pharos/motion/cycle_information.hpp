// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/axis.hpp"
#include "pharos/motion/rotor_spread.hpp"
#include "pharos/motion/sweep_fit.hpp"

namespace pharos::motion {

/// The last sweep of each rotor taken together, as if solved alone: precision factors (22), the residual that no pose
/// explains, and how systematic sensor errors propagate to the pose.
class CycleInformation {
 public:
  /// Residual of both sweeps that no pose and no shift common to a sweep explains: chi-squared and its degrees of
  /// freedom (0: unobservable).
  struct ResidualChi2 {
    double square = 0.0;
    double freedom = 0.0;
  };

  /// Takes a sweep's hits, their residuals against the prediction. `own_variance`: of a hit; noisier ones count less.
  /// `with_rotors`: for covariance_of(RotorSpread) too.
  ResidualChi2 set(Axis axis, const HitFits& hits, double own_variance, std::int64_t time_ticks, bool with_rotors);
  /// The state estimate was moved by `shift` after that sweep: its residuals are now relative to the moved estimate.
  void shifted(Axis axis, const Vector6& shift);

  /// The two sweeps constrain all six directions and are no older than one and a half rotor revolutions.
  bool known() const { return known_; }
  /// Covariance of a pose solved from both sweeps by plain least squares, (17): for errors with variance `own`,
  /// independent for each hit, and one with variance `common`, equal for all hits of a sweep. The last one known, zero
  /// before.
  Matrix6 covariance_of(double own, double common) const;
  /// Its diagonal alone.
  Vector6 variances_of(double own, double common) const;
  /// The same for rotors that are off by such errors, if set() was told to look at them; empty before it was known.
  std::optional<Matrix6> covariance_of(const RotorSpread& spread) const;

 private:
  Matrix6 unit_errors(double own, double common) const;
  struct Sweep {
    Matrix6 square = Matrix6::Zero();  // sum of h h^T
    Vector6 sum = Vector6::Zero();     // sum of h
    // The same, weighted, with the weighted mean taken out of h and residuals.
    Matrix6 centred = Matrix6::Zero();
    Vector6 by_residual = Vector6::Zero();
    double residual_square = 0.0;
    // Sum of h times the derivatives by the rotor's terms.
    Eigen::Matrix<double, 6, kRotorTerms> by_rotor = Eigen::Matrix<double, 6, kRotorTerms>::Zero();
    int hits = 0;
    std::int64_t time_ticks = INT64_MIN;
  };

  std::array<Sweep, kAxes> sweep_;
  Matrix6 unit_ = Matrix6::Zero();
  // Changes of the pose by the terms of both rotors, when both sweeps were last known.
  std::array<Eigen::Matrix<double, 6, kRotorTerms>, kAxes> pose_by_rotor_{};
  bool known_ = false;
  bool rotors_known_ = false;
};

}  // namespace pharos::motion
