// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/cone.hpp"

#include <cmath>
#include <numbers>

#include "pharos/ellipse/matrix.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::ring2 {
namespace {

using ellipse::Matrix5;
using ellipse::Vector5;

// A conic has five parameters; more points than these only average what distortion leaves of the ellipse.
constexpr std::size_t kConePoints = 16;
using Rays = std::array<Vector2, kConePoints>;

std::optional<Rays> rays_of(const ellipse::Ellipse& e, const PinholeCamera& intrinsics) {
  Rays rays;
  for (std::size_t k = 0; k < kConePoints; ++k) {
    const ellipse::PointPx point =
        ellipse::point_at(e, 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kConePoints));
    const Result<Vector2, CameraFailure> ray = undistort(intrinsics, {point.u, point.v});
    if (!ray) return std::nullopt;
    rays[k] = *ray;
  }
  return rays;
}

// Least squares on x^T A x + b^T x = 1 about the points' mean, in units of their spread.
std::optional<Matrix3> conic_through(const Rays& rays) {
  Vector2 mean = Vector2::Zero();
  for (const Vector2& ray : rays) mean += ray / static_cast<double>(kConePoints);
  double square = 0.0;
  for (const Vector2& ray : rays) square += (ray - mean).squaredNorm() / static_cast<double>(kConePoints);
  const double per_spread = 1.0 / std::sqrt(square);
  Matrix5 normal = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  for (const Vector2& ray : rays) {
    const Vector2 x = (ray - mean) * per_spread;
    const Vector5 row(x.x() * x.x(), 2.0 * x.x() * x.y(), x.y() * x.y(), 2.0 * x.x(), 2.0 * x.y());
    add_outer<5>(normal, row, 1.0);
    right += row;
  }
  const auto inverse = positive_inverse<5>(normal);
  if (!inverse) return std::nullopt;
  const Vector5 q = *inverse * right;
  if (!q.allFinite() || !(q[0] * q[2] > q[1] * q[1]) || !(q[0] > 0.0)) return std::nullopt;
  Matrix3 conic;
  conic << q[0], q[1], q[3], q[1], q[2], q[4], q[3], q[4], -1.0;
  Matrix3 change;
  change << per_spread, 0.0, -mean.x() * per_spread, 0.0, per_spread, -mean.y() * per_spread, 0.0, 0.0, 1.0;
  return change.transpose() * conic * change;
}

}  // namespace

std::optional<Cone> cone_of(const ellipse::Ellipse& e, const RigView& view) {
  const std::optional<Rays> rays = rays_of(e, view.intrinsics);
  if (!rays) return std::nullopt;
  const std::optional<Matrix3> conic = conic_through(*rays);
  if (!conic) return std::nullopt;
  const Matrix3& R = view.T_rig_camera.R;
  return Cone{R * *conic * R.transpose(), R.col(2)};
}

std::optional<std::array<CirclePose, 2>> circle_poses(const Cone& cone) {
  const SymmetricEigen<3> axes = symmetric_eigen<3>(cone.Q);
  // Ascending: the first is the cone's axis.
  const double l3 = axes.values[0];
  const double l2 = axes.values[1];
  const double l1 = axes.values[2];
  if (!(l3 < 0.0 && l2 > 0.0)) return std::nullopt;
  const double g = std::sqrt((l2 - l3) / (l1 - l3));
  const double h = std::sqrt((l1 - l2) / (l1 - l3));
  const double range = l2 / std::sqrt(-l1 * l3);
  std::array<CirclePose, 2> poses;
  for (std::size_t k = 0; k < 2; ++k) {
    const double side = k == 0 ? h : -h;
    Vector3 normal = side * axes.vectors.col(2) + g * axes.vectors.col(0);
    Vector3 centre = range * (side * l3 / l2 * axes.vectors.col(2) + g * l1 / l2 * axes.vectors.col(0));
    if (centre.dot(cone.forward) < 0.0) centre = -centre;
    if (normal.dot(centre) > 0.0) normal = -normal;
    poses[k] = {normal, centre};
  }
  return poses;
}

std::optional<ApparentCircle> apparent_circle(const Cone& cone, const Vector3& normal) {
  // Of a circle with centre c, radius R in the plane n X = n c: Q = (nc)^2 I - (nc)(c n^T + n c^T) + (cc - RR) n n^T,
  // so Q c = -R^2 (nc) n.
  const Vector3 pole = cone.Q.inverse() * normal;
  const double length = pole.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  Vector3 direction = pole / length;
  if (direction.dot(cone.forward) < 0.0) direction = -direction;
  if (direction.dot(normal) > 0.0) return std::nullopt;
  const double ratio = direction.dot(cone.Q * direction) / cone.Q.trace();
  const double facing = direction.dot(normal) * direction.dot(normal);
  const double square = -ratio * (facing + 1.0) / (facing - ratio);
  if (!(square > 0.0)) return std::nullopt;
  return ApparentCircle{direction, std::sqrt(square)};
}

}  // namespace pharos::ring2
