// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/manifold.h>

#include <array>

#include "host/vision/slam/feature.hpp"

namespace pharos::slam {

/// A pose as a Ceres parameter block: quaternion x, y, z, w, then translation.
using PoseBlock = std::array<double, 7>;

inline PoseBlock block_of(const CameraFromTarget& pose) {
  const Quaternion q(pose.R);
  return {q.x(), q.y(), q.z(), q.w(), pose.t.x(), pose.t.y(), pose.t.z()};
}

inline CameraFromTarget pose_of(const double* block) {
  const Quaternion q(block[3], block[0], block[1], block[2]);
  return {q.normalized().toRotationMatrix(), Vector3(block[4], block[5], block[6])};
}

/// Steps are Pose::moved_by's delta. Cost functions give their derivatives by delta in the first six columns of seven,
/// so that the derivative of a step is a unit matrix here.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* out) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* delta) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace pharos::slam
