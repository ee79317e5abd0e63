// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "pharos/geometry/types.hpp"

namespace pharos::host {

// Decompositions of any size, compiled once; the portable core's, of fixed sizes, are in pharos/geometry/symmetric.hpp.

/// Eigenvalues in ascending order; eigenvectors are the columns, of unit length.
struct DenseEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a symmetric matrix, of which the lower triangle is read.
DenseEigen dense_eigen(const Eigen::MatrixXd& matrix);

/// x of A x = b for a symmetric A, by L D L^T with pivots.
Eigen::VectorXd dense_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// d^T P^-1 d for a covariance P.
double dense_mahalanobis_squared(const Eigen::VectorXd& d, const Eigen::MatrixXd& P);

struct NearestRotation {
  Matrix3 R;
  Vector3 singular_values;  ///< of C, descending; where the second one is zero, R is one of many
};

/// The rotation R for which trace(R^T C) is greatest: the one next to C, and that of a = R b by least squares for
/// C = sum a b^T (Arun, Huang and Blostein 1987; Umeyama 1991 for the sign).
NearestRotation nearest_rotation(const Matrix3& C);

}  // namespace pharos::host
