// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"

namespace pharos {

// Decompositions of small symmetric matrices, compiled once: each of Eigen's templates costs the compiler one to four
// seconds in every file that asks for it. Another N is a row in symmetric.cpp.

/// Eigenvalues in ascending order; eigenvectors are the columns, of unit length.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// By tridiagonalisation and QR steps; reads the lower triangle. N: 3; for another one Eigen takes storage from the
/// heap.
template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& matrix);

/// x of A x = b, by L D L^T with pivots; reads the lower triangle. Of a singular A an x without the part that A does
/// not determine, or a non-finite one. N: 3, 5 or 6.
template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A, const Eigen::Matrix<double, N, 1>& b);

/// d^T P^-1 d: the squared length of a difference in the standard deviations of its covariance P, N on average for an
/// honest one. P as A of solve_symmetric().
template <int N>
double mahalanobis_squared(const Eigen::Matrix<double, N, 1>& d, const Eigen::Matrix<double, N, N>& P);

}  // namespace pharos
