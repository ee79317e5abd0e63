// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pose_blocks.hpp"

#include <algorithm>

namespace pharos::slam {

bool PoseManifold::Plus(const double* x, const double* delta, double* out) const {
  const PoseBlock moved = block_of(slam::pose_of(x).moved_by(Eigen::Map<const Vector6>(delta)));
  std::copy(moved.begin(), moved.end(), out);
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* delta) const {
  Eigen::Map<Vector6>(delta, 6) = pose_difference(slam::pose_of(y), slam::pose_of(x));
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

}  // namespace pharos::slam
