// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "host/calibrate/parameter_blocks.hpp"

namespace pharos::calibrate {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Covariance and leverage of an adjustment, from its whitened Jacobian.
class Information {
 public:
  /// `jacobian`: rows in any order, columns in the order of ParameterBlocks: calibration, poses, common parts.
  Information(const SparseRows& jacobian, const BundleProblem& problem, const ParameterBlocks& blocks);

  /// Leverage of one row.
  double leverage(std::size_t row) const;
  /// Sigmas before and after of every parameter and of the scale, and the calibration's covariance.
  void fill(BundleResult& result) const;

 private:
  const SparseRows& jacobian_;
  const BundleProblem& problem_;
  const ParameterBlocks& blocks_;
  Eigen::MatrixXd covariance_;  // of all unknowns
};

}  // namespace pharos::calibrate
