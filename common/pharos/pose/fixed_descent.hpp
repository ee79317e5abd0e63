// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/pose/fixed_cholesky.hpp"
#include "pharos/pose/fixed_observation_table.hpp"

namespace pharos::pose {

/// Sums of one linearisation in integers, as NormalEquations. Unknowns: the rotation about the centroid in units of
/// 2^(length_exponent - body_exponent) rad, the centroid's translation in units of length; both in the lighthouse
/// frame.
struct FixedNormal {
  FixedMatrix matrix;                      // Q50
  std::array<std::int64_t, 6> gradient{};  // Q55
  double cost = 0.0;                       // r^T r, rad^2; infinite where a residual is beyond 1/8 rad
};

/// One step of a descent: the rotation in rad and the translation in units of length.
struct FixedStep {
  std::array<fixed::Q30, 6> delta{};  // limited to +-1/2
  double decrease = 0.0;              // of r^T r, that the linear model predicts
  double smallest_pivot_ratio = 1.0;  // not below what FixedCholesky can solve
  bool solved = false;                // false: too near to singular for this arithmetic
};

/// The problem that `descend` and `both_minima` work on, in integers.
class FixedSystem {
 public:
  using State = FixedPose;
  using Normal = FixedNormal;
  using Step = FixedStep;
  static constexpr double kFirstDamping = 0.0;
  static constexpr bool kEndsWhereSingular = true;  // beyond this arithmetic: the caller uses double
  static constexpr bool kSumsAtEnd = false;
  /// As kConvergedFraction; residuals are rounded to 1e-9 rad, which hides a decrease of 3e-4.
  static constexpr double kConverged = 1e-3;
  /// A linearisation costs more than this test whether further ones are useful.
  static constexpr bool kChecksBasin = true;

  explicit FixedSystem(const FixedObservationTable& table) : table_(table) {}

  /// Cost: some 700 instructions a sensor on RV32IM.
  FixedNormal linearise(const FixedPose& pose) const;
  FixedStep step(const FixedNormal& normal, double damping) const;
  FixedPose moved(const FixedPose& pose, const std::array<fixed::Q30, 6>& delta) const;
  /// As mirrored_in_depth.
  FixedPose mirrored(const FixedPose& pose) const;
  bool ahead(const FixedPose& pose) const { return pose.centroid[2] > 0; }
  double square_between(const FixedPose& a, const FixedNormal& normal, const FixedPose& b) const;
  int rows() const { return table_.rows; }

 private:
  const FixedObservationTable& table_;
};

}  // namespace pharos::pose
