// SPDX-License-Identifier: Apache-2.0
#include "host/linear/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace pharos::host {

DenseEigen dense_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd dense_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }

double dense_mahalanobis_squared(const Eigen::VectorXd& d, const Eigen::MatrixXd& P) {
  return d.dot(dense_solve(P, d));
}

NearestRotation nearest_rotation(const Matrix3& C) {
  const Eigen::JacobiSVD<Matrix3> svd(C, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return {svd.matrixU() * Vector3(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose(), svd.singularValues()};
}

}  // namespace pharos::host
