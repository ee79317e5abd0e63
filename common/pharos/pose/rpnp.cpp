// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/rpnp.hpp"

#include <array>
#include <cmath>

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/pose/polynomial.hpp"

namespace pharos::pose {
namespace {

// The unknown is l2 / l1 - cos(angle between the two rays), l the distances of the axis' ends: from the second end at
// the station to the second nineteen times as far as the first.
constexpr double kSmallestUnknown = -1.0, kLargestUnknown = 20.0;

struct Ends {
  std::size_t a = 0, b = 1;
};

// The two rays farthest apart.
Ends widest_pair(const RaySet& set) {
  Ends ends;
  double min_cosine = 2.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(set.count); ++i) {
    for (std::size_t j = i + 1; j < static_cast<std::size_t>(set.count); ++j) {
      const double cosine = set.ray[i].dot(set.ray[j]);
      if (cosine < min_cosine) {
        min_cosine = cosine;
        ends = {i, j};
      }
    }
  }
  return ends;
}

// With l1 = 1, l2 = c12 + x, l3 = c13 + y: the first two sides give y^2 = A1 x^2 + A2, the third
// -y (A4 + c23 x) = A6 x^2 + A3 x + A7; squared, a quartic in x.
Polynomial<4> triplet_constraint(const RaySet& set, const Ends& ends, std::size_t k) {
  const double d12 = (set.body[ends.a] - set.body[ends.b]).squaredNorm();
  const double d13 = (set.body[ends.a] - set.body[k]).squaredNorm();
  const double d23 = (set.body[ends.b] - set.body[k]).squaredNorm();
  const double c12 = set.ray[ends.a].dot(set.ray[ends.b]);
  const double c13 = set.ray[ends.a].dot(set.ray[k]);
  const double c23 = set.ray[ends.b].dot(set.ray[k]);
  const double s12 = set.ray[ends.a].cross(set.ray[ends.b]).squaredNorm();
  const double s13 = set.ray[ends.a].cross(set.ray[k]).squaredNorm();
  const double A1 = d13 / d12, A2 = A1 * s12 - s13, A3 = c13 * c23 - c12, A4 = c12 * c23 - c13;
  const double A6 = (d23 - d12 - d13) / (2.0 * d12);
  const double A7 = 1.0 - c12 * c12 - c13 * c13 + c12 * c13 * c23 + A6 * s12;
  return {A7 * A7 - A2 * A4 * A4, 2.0 * (A3 * A7 - A2 * A4 * c23),
          A3 * A3 + 2.0 * A6 * A7 - A1 * A4 * A4 - A2 * c23 * c23, 2.0 * (A3 * A6 - A1 * A4 * c23),
          A6 * A6 - A1 * c23 * c23};
}

// Derivative of the sum of squares of the constraints of all other sensors.
Polynomial<7> stationarity(const RaySet& set, const Ends& ends) {
  Polynomial<8> sum{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(set.count); ++k) {
    if (k == ends.a || k == ends.b) continue;
    const Polynomial<4> f = triplet_constraint(set, ends, k);
    for (std::size_t i = 0; i <= 4; ++i) {
      for (std::size_t j = 0; j <= 4; ++j) sum[i + j] += f[i] * f[j];
    }
  }
  return derivative<8>(sum);
}

// Orthonormal axes with the third along a direction.
Matrix3 axes_along(const Vector3& direction) {
  Matrix3 axes;
  axes.col(2) = direction.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// Rotation about the axis (cosine, sine) and translation, linear in all bearings: each ray gives two planes through the
// station that contain its sensor.
LighthouseFromBody completed(const RaySet& set, const Ends& ends, const Vector3& axis) {
  const Matrix3 to = axes_along(axis);
  const Matrix3 from = axes_along(set.body[ends.b] - set.body[ends.a]);
  PackedSymmetric<5> normal;
  std::array<double, 5> right{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(set.count); ++k) {
    const Vector3 q = from.transpose() * (set.body[k] - set.body[ends.a]);
    const Vector3 with_cosine = to.col(0) * q.x() + to.col(1) * q.y();
    const Vector3 with_sine = to.col(1) * q.x() - to.col(0) * q.y();
    const Vector3 known = to.col(2) * q.z();
    const Vector3& ray = set.ray[k];
    for (const Vector3& plane : {Vector3(ray.z(), 0.0, -ray.x()), Vector3(0.0, ray.z(), -ray.y())}) {
      const std::array<double, 5> row{plane.dot(with_cosine), plane.dot(with_sine), plane.x(), plane.y(), plane.z()};
      for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; j <= i; ++j) normal(i, j) += row[i] * row[j];
        right[i] -= row[i] * plane.dot(known);
      }
    }
  }
  const std::array<double, 5> x = Factorisation<5>(normal).solve(right);
  const double length = std::hypot(x[0], x[1]);
  Matrix3 turn = Matrix3::Identity();
  if (length > 0.0) turn.topLeftCorner<2, 2>() << x[0] / length, -x[1] / length, x[1] / length, x[0] / length;
  LighthouseFromBody pose;
  pose.R = to * turn * from.transpose();
  pose.t = Vector3(x[2], x[3], x[4]) - pose.R * set.body[ends.a];
  return pose;
}

}  // namespace

StartPoses rpnp(const RaySet& set) {
  StartPoses poses;
  if (set.count < 3) return poses;
  const Ends ends = widest_pair(set);
  const Polynomial<7> slope = stationarity(set, ends);
  const Polynomial<6> curvature = derivative<7>(slope);
  const RealRoots<7> roots = real_roots<7>(slope, kSmallestUnknown, kLargestUnknown);
  for (std::size_t k = 0; k < roots.count; ++k) {
    if (!(value_at<6>(curvature, roots.root[k]) > 0.0)) continue;
    const double far_end = set.ray[ends.a].dot(set.ray[ends.b]) + roots.root[k];
    const LighthouseFromBody pose = completed(set, ends, far_end * set.ray[ends.b] - set.ray[ends.a]);
    if (pose.is_finite()) poses.push_back(pose);
  }
  return poses;
}

}  // namespace pharos::pose
