// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include <cmath>

#include "host/vision/slam/pose_blocks.hpp"
#include "host/vision/slam/pose_only.hpp"

namespace pharos::slam {

/// One observation of (12), over a pose (PoseBlock) and a point; rows are whitened. Evaluation fails where the point is
/// not in front of the camera.
class Reprojection : public ceres::CostFunction {
 public:
  Reprojection(const Observation& seen, const StereoCamera& camera) : seen_(seen), camera_(camera) {
    set_num_residuals(seen.stereo() ? 3 : 2);
    mutable_parameter_block_sizes()->assign({7, 3});
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const CameraFromTarget pose = slam::pose_of(parameters[0]);
    Observation at = seen_;
    at.point_m = Vector3(parameters[1]);
    if (!((pose * at.point_m).z() > kMinDepth_m)) return false;
    const double weight = 1.0 / std::sqrt(seen_.variance_px2);
    const Vector3 e = weight * residual_of(at, camera_, pose);
    const int rows = num_residuals();
    for (int k = 0; k < rows; ++k) residuals[k] = e[k];
    if (jacobians == nullptr) return true;
    const Eigen::Matrix<double, 3, 6> J = weight * residual_jacobian(at, camera_, pose);
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> out(jacobians[0], rows, 7);
      out.leftCols<6>() = J.topRows(rows);
      out.col(6).setZero();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> out(jacobians[1], rows, 3);
      out = (J.rightCols<3>() * pose.R).topRows(rows);
    }
    return true;
  }

 private:
  Observation seen_;
  StereoCamera camera_;
};

}  // namespace pharos::slam
