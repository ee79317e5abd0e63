// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::test {

using CameraFromTarget = Pose<frame::Camera, frame::Target>;

/// A minimal scene for measurements of a docking ring: a flat ring in front of a flat wall, and boxes on that. For
/// tests with exact truth; for all others there is the simulator.
struct SyntheticRing {
  double outer_radius_m = 0.55;
  double inner_radius_m = 0.49;
  double wall_z_m = -0.1;     ///< behind the ring's plane; 0: ring and plates are painted on the wall
  double wall_grey = 1500.0;  ///< counts
  double ring_grey = 8000.0;
  double plate_grey = 7000.0;
  double plate_z_m = -0.03;
  double plate_side_m = 0.12;
  std::vector<Vector2> plates{Vector2(0.66, 0.0)};  ///< centres, in T
  std::vector<Vector2> sides;                       ///< of the first plates, along x and y; the others are square
  double wall_light = 1.0;                          ///< of upright walls, over the cosine law's
  bool has_ring_walls = false;  ///< from the ring's edges down to the wall behind it; without: a sheet

  Vector2 half_sides(std::size_t plate) const {
    return 0.5 * (plate < sides.size() ? sides[plate] : Vector2(plate_side_m, plate_side_m));
  }
};

struct SyntheticFrame {
  std::vector<std::uint16_t> intensity;
  std::vector<std::uint16_t> depth;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;

  tof::TofFrame view() const { return {{intensity.data(), width_px, height_px}, {depth.data(), width_px, height_px}}; }
};

/// 320 x 240 pixels, a lens with some distortion: half the Helios, for speed.
inline DepthCamera small_camera() {
  DepthCamera camera;
  camera.intrinsics = {320, 240, 304.3, 302.5, 160.9, 119.5, {-0.1991, 0.0809, 0.0021, -0.0002, 0.0}};
  return camera;
}

/// Target facing the camera, rotated by the matrices of (8): columns of R_C_T are the target's axes.
inline CameraFromTarget facing(const Vector3& centre_m, const Vector3& turn_rad) {
  CameraFromTarget pose;
  pose.R = rotation_exp(turn_rad) * Vector3(1.0, -1.0, -1.0).asDiagonal();
  pose.t = centre_m;
  return pose;
}

/// Every pixel the mean of 5 x 5 rays; depths mix by brightness, as in a real pixel. No noise.
SyntheticFrame render(const SyntheticRing& scene, const CameraFromTarget& T_camera_target, const DepthCamera& camera);

/// White noise on both images.
SyntheticFrame with_noise(SyntheticFrame frame, double depth_sigma_counts, double grey_sigma, unsigned seed);

}  // namespace pharos::test
