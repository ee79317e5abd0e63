// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring2_pose.hpp"

#include <cmath>
#include <numbers>

namespace pharos::host {
namespace {

using Matrix65 = Eigen::Matrix<double, 6, 5>;

constexpr double kAnyTurn_rad2 = std::numbers::pi * std::numbers::pi / 3.0;
// Above this value the rig's x axis is too nearly parallel to the normal to define a direction across it.
constexpr double kMaxAlongX = 0.99;

Pose<frame::Rig, frame::Target> pose_of(const Vector3& normal, const Vector3& centre_m) {
  const bool along_x = std::abs(normal.x()) > kMaxAlongX;
  const Vector3 towards = along_x ? Vector3::UnitY().eval() : Vector3::UnitX().eval();
  Pose<frame::Rig, frame::Target> pose;
  pose.R.col(2) = normal;
  pose.R.col(1) = normal.cross(towards).normalized();
  pose.R.col(0) = pose.R.col(1).cross(pose.R.col(2));
  pose.t = centre_m;
  return pose;
}

}  // namespace

PoseEstimate<frame::Rig, frame::Target> ring2_pose(const ring2::Ring2Estimate& circles, double focal_px) {
  PoseEstimate<frame::Rig, frame::Target> estimate;
  estimate.pose = pose_of(circles.normal, circles.ring_centre_m);
  Matrix65 jacobian = Matrix65::Zero();
  jacobian.col(0).head<3>() = circles.tilt_axes[0];
  jacobian.col(1).head<3>() = circles.tilt_axes[1];
  jacobian.block<3, 3>(3, 2) = Matrix3::Identity();
  estimate.covariance = jacobian * circles.covariance.topLeftCorner<5, 5>() * jacobian.transpose();
  estimate.covariance.topLeftCorner<3, 3>() += kAnyTurn_rad2 * circles.normal * circles.normal.transpose();
  estimate.residual_rms = circles.rms_px / focal_px;
  estimate.iterations = circles.iterations;
  if (circles.second) {
    estimate.second = {pose_of(circles.second->normal, circles.second->ring_centre_m), circles.second->delta_chi2};
  }
  return estimate;
}

}  // namespace pharos::host
