// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::tof {

/// A rectangle in a plane parallel to the ring's, in the axes of axes_of(normal) about the ring's centre.
struct PlanarRectangle {
  Vector2 centre_m = Vector2::Zero();
  double angle_rad = 0.0;  ///< of its first side, from the first axis
  Vector2 half_sides_m = Vector2::Zero();

  /// Outward normal of a side: 0 to 3, the first along angle_rad.
  Vector2 outward(int side) const {
    const double angle = angle_rad + 0.5 * kPi * side;
    return {std::cos(angle), std::sin(angle)};
  }
  /// Distance of a side from the centre.
  double half_side(int side) const { return half_sides_m[side % 2]; }
  bool holds(const Vector2& place_m) const {
    const Vector2 off = place_m - centre_m;
    return std::fabs(outward(0).dot(off)) <= half_sides_m.x() && std::fabs(outward(1).dot(off)) <= half_sides_m.y();
  }
  double area_m2() const { return 4.0 * half_sides_m.x() * half_sides_m.y(); }
  /// Longer over shorter side.
  double slenderness() const { return half_sides_m.maxCoeff() / half_sides_m.minCoeff(); }
};

}  // namespace pharos::tof
