// SPDX-License-Identifier: Apache-2.0
#include "support/synthetic_ring.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace pharos::test {
namespace {

constexpr int kSide = 5;  // rays of a pixel

struct Light {
  double grey = 0.0;
  double z_m = 0.0;
};

// Where a line in T meets a cylinder about z: the nearer or the farther place; NaN where it does not.
double meet_cylinder(const Vector3& eye, const Vector3& d, double radius_m, bool farther) {
  const double a = d.head<2>().squaredNorm(), b = eye.head<2>().dot(d.head<2>());
  const double root = std::sqrt(b * b - a * (eye.head<2>().squaredNorm() - radius_m * radius_m));
  return (-b + (farther ? root : -root)) / a;
}

// Intersection of a ray: the nearest of ring, plates and wall.
Light trace(const SyntheticRing& scene, const CameraFromTarget& T_target_camera, const Vector3& ray) {
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

// All rays of all pixels in turn. Tests render many frames of few cameras, so those of the last one are kept.
const std::vector<Vector2>& rays_of(const PinholeCamera& camera) {
  static std::vector<Vector2> rays;
  static PinholeCamera last;
  if (!rays.empty() && camera == last) return rays;
  rays.clear();
  for (std::int32_t v = 0; v < camera.height_px; ++v) {
    for (std::int32_t u = 0; u < camera.width_px; ++u) {
      for (int k = 0; k < kSide * kSide; ++k) {
        const int row = k / kSide;
        const Vector2 pixel(u + (k % kSide + 0.5) / kSide - 0.5, v + (row + 0.5) / kSide - 0.5);
        rays.push_back(*undistort(camera, pixel));
      }
    }
  }
  last = camera;
  return rays;
}

}  // namespace

SyntheticFrame render(const SyntheticRing& scene, const CameraFromTarget& T_camera_target, const DepthCamera& camera) {
  const Pose<frame::Target, frame::Camera> inverse = T_camera_target.inverse();
  const CameraFromTarget T_target_camera{inverse.R, inverse.t};
  SyntheticFrame frame;
  frame.width_px = camera.intrinsics.width_px;
  frame.height_px = camera.intrinsics.height_px;
  const Vector2* ray = rays_of(camera.intrinsics).data();
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      double grey = 0.0;
      double moment = 0.0;
      for (int k = 0; k < kSide * kSide; ++k) {
        const Light light = trace(scene, T_target_camera, {ray->x(), ray->y(), 1.0});
        ++ray;
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

SyntheticFrame with_noise(SyntheticFrame frame, double depth_sigma_counts, double grey_sigma, unsigned seed) {
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
