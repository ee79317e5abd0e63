// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/symmetric.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pharos {

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& A,
                                            const Eigen::Matrix<double, N, 1>& b) {
  return A.ldlt().solve(b);
}

template <int N>
double mahalanobis_squared(const Eigen::Matrix<double, N, 1>& d, const Eigen::Matrix<double, N, N>& P) {
  return d.dot(solve_symmetric<N>(P, d));
}

#define PHAROS_SOLVE(N)                                                                        \
  template Eigen::Matrix<double, N, 1> solve_symmetric<N>(const Eigen::Matrix<double, N, N>&,  \
                                                          const Eigen::Matrix<double, N, 1>&); \
  template double mahalanobis_squared<N>(const Eigen::Matrix<double, N, 1>&, const Eigen::Matrix<double, N, N>&)

PHAROS_SOLVE(3);
PHAROS_SOLVE(5);
PHAROS_SOLVE(6);
#undef PHAROS_SOLVE

template SymmetricEigen<3> symmetric_eigen<3>(const Matrix3&);

}  // namespace pharos
