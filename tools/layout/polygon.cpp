// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "tools/layout/convex_body.hpp"

namespace pharos::layout {
namespace {

/// Signed distance of `p` from the line from a to b, positive to the left, m.
double left_of(const Vector2& a, const Vector2& b, const Vector2& p) {
  const Vector2 along = (b - a).normalized();
  return along.x() * (p - a).y() - along.y() * (p - a).x();
}

std::vector<Vector2> clipped(const std::vector<Vector2>& polygon, const Vector2& a, const Vector2& b, double margin_m) {
  std::vector<Vector2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2& q = polygon[(i + 1) % polygon.size()];
    const double dp = left_of(a, b, p) - margin_m;
    const double dq = left_of(a, b, q) - margin_m;
    if (dp >= 0.0) kept.push_back(p);
    if ((dp >= 0.0) != (dq >= 0.0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

}  // namespace

std::vector<Vector2> inset(const std::vector<Vector2>& corners, double margin_m) {
  std::vector<Vector2> polygon = corners;
  for (std::size_t i = 0; i < corners.size() && !polygon.empty(); ++i) {
    polygon = clipped(polygon, corners[i], corners[(i + 1) % corners.size()], margin_m);
  }
  return polygon;
}

Vector2 nearest_within(const std::vector<Vector2>& corners, const Vector2& xy) {
  bool inside = true;
  Vector2 nearest = corners.front();
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2& a = corners[i];
    const Vector2 side = corners[(i + 1) % corners.size()] - a;
    const double length2 = side.squaredNorm();
    if (!(length2 > 0.0)) continue;
    inside = inside && side.x() * (xy - a).y() - side.y() * (xy - a).x() >= 0.0;
    const Vector2 p = a + side * std::clamp(side.dot(xy - a) / length2, 0.0, 1.0);
    if ((p - xy).squaredNorm() < minimum) minimum = (p - xy).squaredNorm(), nearest = p;
  }
  return inside && corners.size() > 2 ? xy : nearest;
}

}  // namespace pharos::layout
