// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::layout {

/// A face of a body, with its own coordinates: a point is origin + x u + y v, body frame, m.
struct Facet {
  Vector3 normal;  // outward, unit length
  Vector3 origin;
  Vector3 u;
  Vector3 v;
  std::vector<Vector2> corners;  // convex, anticlockwise seen from outside

  Vector3 at(const Vector2& xy) const { return origin + xy.x() * u + xy.y() * v; }
};

/// A convex polyhedron; coplanar faces are joined.
struct ConvexBody {
  std::vector<Facet> facets;
  Vector3 low = Vector3::Zero();  // bounding box, m
  Vector3 high = Vector3::Zero();
};

/// Reads an OFF file (`OFF`, counts, vertices in metres, faces as `n i j k …`, anticlockwise seen from outside;
/// comments with #; .gz; -). Throws host::InputError naming file and line for anything but a closed convex body of 5 mm
/// to 12 m.
ConvexBody read_body(const std::string& path);

/// The convex polygon of the points of `corners` at least `margin_m` from each side; empty where there is none.
std::vector<Vector2> inset(const std::vector<Vector2>& corners, double margin_m);

/// The point of a convex polygon (not empty) that is nearest to `xy`.
Vector2 nearest_within(const std::vector<Vector2>& corners, const Vector2& xy);

}  // namespace pharos::layout
