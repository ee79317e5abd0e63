// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
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

namespace synthetic {

struct Light {
  double grey = 0.0;
  double z_m = 0.0;
};

// Where a line in T meets a cylinder about z: the nearer or the farther place; NaN where it does not.
inline double meet_cylinder(const Vector3& eye, const Vector3& d, double radius_m, bool farther) {
  const double a = d.head<2>().squaredNorm(), b = eye.head<2>().dot(d.head<2>());
  const double root = std::sqrt(b * b - a * (eye.head<2>().squaredNorm() - radius_m * radius_m));
  return (-b + (farther ? root : -root)) / a;
}

// Intersection of a ray: the nearest of ring, plates and wall.
inline Light trace(const SyntheticRing& scene, const CameraFromTarget& T_target_camera, const Vector3& ray) {
  const Vector3& eye = T_target_camera.t;
  const Vector3 d = T_target_camera.R * ray;  // scaled so that its parameter is the depth
  const auto at = [&](double plane_z) { return (plane_z - eye.z()) / d.z(); };
  const auto plan = [&](double s) -> Vector2 { return (eye + s * d).head<2>(); };
  const double ring = at(0.0);
  const double radius = plan(ring).norm();
  if (radius <= scene.outer_radius_m && radius >= scene.inner_radius_m) {
    return {scene.ring_grey, scene.wall_z_m == 0.0 ? at(0.0) : ring};
  }
  for (const bool is_inner : {false, true}) {
    if (!scene.has_ring_walls) break;
    const double radius_m = is_inner ? scene.inner_radius_m : scene.outer_radius_m;
    const double s = meet_cylinder(eye, d, radius_m, is_inner), z = eye.z() + s * d.z();
    if (!(z < 0.0 && z > scene.wall_z_m)) continue;
    const double cosine = std::fabs(plan(s).dot(d.head<2>())) / (radius_m * std::fabs(d.z()));
    return {scene.ring_grey * scene.wall_light * cosine, s};
  }
  const double plate = at(scene.wall_z_m == 0.0 ? 0.0 : scene.plate_z_m);
  for (std::size_t k = 0; k < scene.plates.size(); ++k) {
    const Vector2 &middle = scene.plates[k], half = scene.half_sides(k);
    const Vector2 off = plan(plate) - middle;
    if (std::fabs(off.x()) <= half.x() && std::fabs(off.y()) <= half.y()) return {scene.plate_grey, plate};
    for (int axis = 0; axis < 2; ++axis) {  // the sides that face the camera
      const double side = middle[axis] + (d[axis] < 0.0 ? half[axis] : -half[axis]);
      const double s = (side - eye[axis]) / d[axis];
      const double z = eye.z() + s * d.z();
      if (s > 0.0 && z < scene.plate_z_m && z > scene.wall_z_m &&
          std::fabs(plan(s)[1 - axis] - middle[1 - axis]) <= half[1 - axis]) {
        return {scene.plate_grey * scene.wall_light * std::fabs(d[axis] / d.z()), s};
      }
    }
  }
  return {scene.wall_grey, at(scene.wall_z_m)};
}

}  // namespace synthetic

/// Every pixel the mean of 5 x 5 rays; depths mix by brightness, as in a real pixel. No noise.
inline SyntheticFrame render(const SyntheticRing& scene, const CameraFromTarget& T_camera_target,
                             const DepthCamera& camera) {
  constexpr int kSide = 5;
  const Pose<frame::Target, frame::Camera> inverse = T_camera_target.inverse();
  const CameraFromTarget T_target_camera{inverse.R, inverse.t};
  SyntheticFrame frame;
  frame.width_px = camera.intrinsics.width_px;
  frame.height_px = camera.intrinsics.height_px;
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      double grey = 0.0;
      double moment = 0.0;
      for (int k = 0; k < kSide * kSide; ++k) {
        const int row = k / kSide;
        const Vector2 pixel(u + (k % kSide + 0.5) / kSide - 0.5, v + (row + 0.5) / kSide - 0.5);
        const Vector2 ray = *undistort(camera.intrinsics, pixel);
        const synthetic::Light light = synthetic::trace(scene, T_target_camera, {ray.x(), ray.y(), 1.0});
        grey += light.grey;
        moment += light.grey * light.z_m;
      }
      frame.intensity.push_back(static_cast<std::uint16_t>(grey / (kSide * kSide) + 0.5));
      const double counts = (moment / grey - camera.depth_origin_z_m) / camera.depth_scale_m + 0.5;
      frame.depth.push_back(static_cast<std::uint16_t>(std::clamp(counts, 0.0, 65535.0)));
    }
  }
  return frame;
}

/// White noise on both images.
inline SyntheticFrame with_noise(SyntheticFrame frame, double depth_sigma_counts, double grey_sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (std::uint16_t& counts : frame.depth) {
    if (!has_depth(counts)) continue;
    counts = static_cast<std::uint16_t>(std::clamp(counts + depth_sigma_counts * normal(random) + 0.5, 1.0, 65534.0));
  }
  for (std::uint16_t& grey : frame.intensity) {
    grey = static_cast<std::uint16_t>(std::clamp(grey + grey_sigma * normal(random) + 0.5, 0.0, 65535.0));
  }
  return frame;
}

}  // namespace pharos::test
