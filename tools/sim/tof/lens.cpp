// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/lens.hpp"

#include <cmath>
#include <string>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

constexpr int kNewtonSteps = 20;
constexpr double kConverged = 1e-13;
// Central differences of a polynomial of degree 7: exact to 1e-9 of the slope, enough for Newton's method.
constexpr double kStep = 1e-5;

}  // namespace

Vector2 Lens::distorted(const Vector2& ray) const {
  const auto& [k1, k2, p1, p2, k3] = model_.distortion;
  const double x = ray.x();
  const double y = ray.y();
  const double square = x * x + y * y;
  const double radial = 1.0 + square * (k1 + square * (k2 + square * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
          y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y};
}

std::optional<Vector2> Lens::undistorted(const Vector2& seen, const Vector2& start) const {
  Vector2 ray = start;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Vector2 miss = seen - distorted(ray);
    Eigen::Matrix2d slope;
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 h = kStep * Vector2::Unit(axis);
      slope.col(axis) = (distorted(ray + h) - distorted(ray - h)) / (2.0 * kStep);
    }
    // Beyond the radius where the picture folds over, a ray exists but is not the one that light takes.
    if (slope.determinant() < 0.1) return std::nullopt;
    ray += slope.inverse() * miss;
    if (miss.norm() < kConverged) return ray;
  }
  return std::nullopt;
}

Lens::Lens(const LensModel& model) : model_(model) {
  rays_.reserve(static_cast<std::size_t>(model.width_px + 2) * static_cast<std::size_t>(model.height_px + 2));
  Vector2 row_start = Vector2::Zero();
  for (int v = -1; v <= model.height_px; ++v) {
    Vector2 start = v == -1 ? Vector2((-1 - model.cx_px) / model.fx_px, (-1 - model.cy_px) / model.fy_px) : row_start;
    for (int u = -1; u <= model.width_px; ++u) {
      const Vector2 seen((u - model.cx_px) / model.fx_px, (v - model.cy_px) / model.fy_px);
      const std::optional<Vector2> ray = undistorted(seen, start);
      if (!ray) {
        throw host::InputError("camera: distortion: no light reaches pixel " + std::to_string(u) + ", " +
                               std::to_string(v) + " under this distortion; use terms that hold over the whole image");
      }
      rays_.push_back(*ray);
      start = *ray;
      if (u == -1) row_start = *ray;
    }
  }
  lengths_.reserve(static_cast<std::size_t>(model.width_px) * static_cast<std::size_t>(model.height_px));
  for (int v = 0; v < model.height_px; ++v) {
    for (int u = 0; u < model.width_px; ++u) lengths_.push_back(std::sqrt(1.0 + ray(u, v).squaredNorm()));
  }
}

Eigen::Matrix2d Lens::slope(int u, int v) const {
  Eigen::Matrix2d slope;
  slope.col(0) = 0.5 * (ray(u + 1, v) - ray(u - 1, v));
  slope.col(1) = 0.5 * (ray(u, v + 1) - ray(u, v - 1));
  return slope;
}

Vector2 Lens::project(const Vector3& point_camera_m) const {
  const Vector2 seen = distorted(point_camera_m.head<2>() / point_camera_m.z());
  return {model_.fx_px * seen.x() + model_.cx_px, model_.fy_px * seen.y() + model_.cy_px};
}

}  // namespace pharos::sim
