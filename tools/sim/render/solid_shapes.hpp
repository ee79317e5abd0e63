// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/sim/render/primitives.hpp"
#include "tools/sim/render/solid_scene.hpp"

namespace pharos::sim {

/// Where a ray meets a shape, in the shape's frame: depth along the ray, unit normal (either side), place on the
/// surface.
struct SolidHit {
  double depth = kNever;
  Vector3 normal = Vector3::UnitZ();
  Vector2 place_m = Vector2::Zero();
  int face = 0;  ///< of a box
};

/// Nearest hit ahead of `nearest`; depth kNever where there is none.
SolidHit meet(const SolidBox& box, const Vector3& origin, const Vector3& direction, double nearest);
SolidHit meet(const FlatRing& ring, const Vector3& origin, const Vector3& direction, double nearest);
SolidHit meet(const ConeShell& cone, const Vector3& origin, const Vector3& direction, double nearest);
SolidHit meet(const Dish& dish, const Vector3& origin, const Vector3& direction, double nearest);

/// A sphere around the shape: centre in its frame, radius.
struct Bounds {
  Vector3 centre_m = Vector3::Zero();
  double radius_m = 0.0;
};
Bounds bounds_of(const Solid& solid);

}  // namespace pharos::sim
