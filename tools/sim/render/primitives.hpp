// SPDX-License-Identifier: Apache-2.0
#pragma once

// Intersections of rays and surfaces. A ray is origin + s direction; s is in units of the direction's length, so that
// with directions (x/z, y/z, 1) in a camera's frame it is the depth. Inline: some are called for every ray of every
// image.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// Depth of a ray without an intersection.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// A plane with coordinates of its own, corner + s edge_s + t edge_t, for rays that begin at the frame's origin.
class PlaneCoordinates {
 public:
  PlaneCoordinates(const Vector3& corner, const Vector3& edge_s, const Vector3& edge_t)
      : normal_(edge_s.cross(edge_t).normalized()) {
    const Vector3 across_s = edge_t.cross(normal_), across_t = normal_.cross(edge_s);
    dual_s_ = across_s / across_s.dot(edge_s);
    dual_t_ = across_t / across_t.dot(edge_t);
    offset_ = normal_.dot(corner);
    s0_ = -dual_s_.dot(corner);
    t0_ = -dual_t_.dot(corner);
  }

  const Vector3& normal() const { return normal_; }
  /// Where the ray meets the plane; negative behind its origin.
  double depth(const Vector3& direction) const { return offset_ / normal_.dot(direction); }
  /// Coordinates of the point at `depth` on the ray.
  double s(const Vector3& direction, double depth) const { return depth * dual_s_.dot(direction) + s0_; }
  double t(const Vector3& direction, double depth) const { return depth * dual_t_.dot(direction) + t0_; }

 private:
  Vector3 normal_, dual_s_, dual_t_;
  double offset_ = 0.0, s0_ = 0.0, t0_ = 0.0;
};

/// Where a ray meets the plane z = `level`.
inline double meet_level(const Vector3& origin, const Vector3& direction, double level) {
  return (level - origin.z()) / direction.z();
}

/// Both places where a ray meets the cone of radius base + slope (z - base_z) around z, the nearer one first; a slope
/// of 0 is a cylinder. The mirrored half of the cone is left to the caller's limits in z. kNever, kNever where it
/// misses.
inline std::array<double, 2> meet_cone(const Vector3& origin, const Vector3& direction, double base, double slope,
                                       double base_z) {
  const Vector3 &o = origin, &d = direction;
  const double radius = base + slope * (o.z() - base_z);
  const double growth = slope * d.z();
  const double a = d.x() * d.x() + d.y() * d.y() - growth * growth;
  const double b = o.x() * d.x() + o.y() * d.y() - radius * growth;
  const double c = o.x() * o.x() + o.y() * o.y() - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || std::abs(a) < 1e-12) return {kNever, kNever};
  const double root = std::sqrt(discriminant);
  const double first = (-b - root) / a;
  const double second = (-b + root) / a;
  return first < second ? std::array{first, second} : std::array{second, first};
}

/// Depth at which a ray enters a box, and the axis normal to that face; kNever if it misses the box, or begins inside
/// or behind it.
struct BoxEntry {
  double at = kNever;
  int axis = 0;
};
inline BoxEntry enter_box(const Vector3& origin, const Vector3& direction, const Vector3& low, const Vector3& high) {
  BoxEntry entry{-kNever, 0};
  double leave = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / direction[axis];
    const double one = (low[axis] - origin[axis]) * inverse;
    const double other = (high[axis] - origin[axis]) * inverse;
    const double enter = std::min(one, other);
    if (enter > entry.at) entry = {enter, axis};
    leave = std::min(leave, std::max(one, other));
  }
  if (entry.at > leave || entry.at <= 0.0) return {};
  return entry;
}

}  // namespace pharos::sim
