// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos::motion {

/// The information of a sweep's hits about the pose, summed: H^T R^-1 H, H^T R^-1 r and r^T R^-1 r in compact form.
///
/// H = L^T in the whitened sense: `factor` L is lower triangular with L L^T = H^T R^-1 H (6x6, rank at most five, as
/// one rotor never observes all six directions; columns without rank are zero), `whitened` beta solves L beta = H^T
/// R^-1 r, and `residual_chi2` is the part of r^T R^-1 r that no pose explains: chi-squared of hits - rank.
struct SweepInformation {
  Matrix6 factor = Matrix6::Zero();
  Vector6 whitened = Vector6::Zero();
  double residual_chi2 = 0.0;
  int rank = 0;
  int hits = 0;
};

/// Sums over hits with noise R = diag(own variance) + common variance x 1 1^T: what rotor and flash add to all hits of
/// one sweep equally. By the Woodbury identity two extra sums carry the common part exactly.
class InformationSums {
 public:
  /// A hit: derivatives of its bearing by the pose error, innovation (rad), 1 / own variance.
  void add(const Vector6& jacobian, double residual_rad, double weight);
  SweepInformation close(double common_variance) const;

 private:
  Matrix6 square_ = Matrix6::Zero();  // its lower triangle
  Vector6 by_residual_ = Vector6::Zero();
  Vector6 sum_ = Vector6::Zero();
  double weight_ = 0.0;
  double residual_sum_ = 0.0;
  double residual_square_ = 0.0;
  int hits_ = 0;
};

/// The same for hits whose noise also has a part that is linear in where they are, R = diag(own variance) + common
/// variance x 1 1^T + Q W Q^T, a row of Q a hit's place. What is shared is eliminated as an unknown with a prior.
class SharedSums {
 public:
  /// `place_covariance`: W, positive semidefinite.
  SharedSums(const Matrix3& place_covariance, double common_variance);
  void add(const Vector6& jacobian, double residual_rad, double weight, const Vector3& place);
  SweepInformation close() const;
  /// ln of the factor by which the part of the places makes the determinant of R larger.
  double log_determinant() const;

 private:
  // Rows and columns: the six of the pose, the residual, the common part, three of the places.
  static constexpr int kResidual = 6, kShared = 7, kPlaces = 8, kAll = 11;
  using Sums = Eigen::Matrix<double, kAll, kAll>;

  Sums sum_ = Sums::Zero();
  Matrix3 place_root_;  // lower triangular
  double common_root_;
  int hits_ = 0;
};

}  // namespace pharos::motion
