// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// One camera of a simulated rig. Pixel (0, 0) is the centre of the first pixel; distortion k1, k2, p1, p2, k3 as in
/// OpenCV; p_rig = R p_camera + t, both frames x right, y down, z ahead.
struct StereoCamera {
  std::int32_t width_px = 1280;
  std::int32_t height_px = 1024;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 5> distortion{};
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
