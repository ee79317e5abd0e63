// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/geometry/pose.hpp"
#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

using CameraFromTarget = Pose<frame::Camera, frame::Target>;

/// Angles (8) of paper 000, rad, of diag(1, -1, -1) R_C_T = Rx(alpha) Ry(beta) Rz(gamma): the printed arctan is right
/// for a facing target with |gamma| < 90 deg, atan2 beyond as well. All 0: Z' looks at the camera and X' to the right.
struct TargetAngles {
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double gamma_rad = 0.0;
};
TargetAngles angles_of(const Matrix3& R_camera_target);
/// (6): the attitude that has these angles.
Matrix3 attitude_of(const TargetAngles& angles);

/// A pose of the target frame: origin at the ring's centre, Z' its normal towards the camera, X' towards the
/// connector's face as seen along Z' (n_y = n_z x X, n_x = n_y x n_z, paper 000, 2.3).
struct TargetPose {
  CameraFromTarget pose;
  /// Rotation (rad) before translation (m), in the camera frame.
  Matrix6 covariance = Matrix6::Zero();
};

/// With a connector: six degrees of freedom. The uncertainty of its position and the ring's enter the turn about Z'.
TargetPose target_pose(const RingFit& ring, const ConnectorFace& face);

/// The same with a connector whose direction from the ring's centre, in T, is `direction_rad` from X' towards Y', known
/// to `direction_sigma_rad`.
TargetPose target_pose(const RingFit& ring, const ConnectorFace& face, double direction_rad,
                       double direction_sigma_rad);

/// Without one: five. X' is as near to the camera's x axis as possible, and the variance about Z' is that of a uniform
/// angle, pi^2 / 3.
TargetPose target_pose_without_turn(const RingFit& ring);

}  // namespace pharos::tof
