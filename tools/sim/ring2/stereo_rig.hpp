// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "tools/sim/optics/lens.hpp"

namespace pharos::sim {

/// One camera of a simulated rig: a lens and where it stands, p_rig = R p_camera + t, both frames x right, y down, z
/// ahead.
struct StereoCamera : Lens {
  Matrix3 R_rig_camera = Matrix3::Identity();
  Vector3 t_rig_camera_m = Vector3::Zero();
};

/// Left, right.
using StereoRig = std::array<StereoCamera, 2>;

/// The rig of paper 001: cameras `baseline_m` apart on the x axis, each turned inwards by `toe_in_rad`; principal point
/// in the image's middle.
StereoRig symmetric_rig(double baseline_m, double toe_in_rad, double focal_px, std::int32_t width_px,
                        std::int32_t height_px);

/// A circle in the rig's frame.
struct SpaceCircle {
  Vector3 centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();  ///< unit, towards the cameras
  double radius_m = 0.0;
};

/// Ring and nozzle: one axis, the nozzle's centre `distance_m` from the ring's along the normal.
struct RingAndNozzle {
  Vector3 ring_centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();
  double ring_radius_m = 0.56;  ///< the sizes of paper 001
  double nozzle_radius_m = 0.1485;
  double distance_m = 0.5;

  SpaceCircle ring() const { return {ring_centre_m, normal, ring_radius_m}; }
  SpaceCircle nozzle() const { return {ring_centre_m + distance_m * normal, normal, nozzle_radius_m}; }
};

/// Rx(theta) Ry(gamma) (0, 0, -1).
Vector3 facing_normal(double theta_rad, double gamma_rad);

}  // namespace pharos::sim
