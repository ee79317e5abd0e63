// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/polygon.hpp"

#include <array>

namespace pharos::ellipse {
namespace {

// The point between `first` and `last` that lies farthest from their chord, or 0 where all are within the tolerance.
std::uint16_t farthest(std::span<const EdgePoint> points, std::uint16_t first, std::uint16_t last, float tolerance) {
  const EdgePoint &a = points[first], &b = points[last];
  const float du = b.u_px - a.u_px, dv = b.v_px - a.v_px;
  const float chord = du * du + dv * dv;
  // A contour that closes has no chord: distances from its start are used.
  const bool closed = chord < 4.0F * tolerance * tolerance;
  float maximum = tolerance * tolerance * (closed ? 1.0F : chord);
  std::uint16_t place = 0;
  for (auto k = static_cast<std::uint16_t>(first + 1); k < last; ++k) {
    const float u = points[k].u_px - a.u_px, v = points[k].v_px - a.v_px;
    const float across = u * dv - v * du;
    const float squared = closed ? u * u + v * v : across * across;
    if (squared <= maximum) continue;
    maximum = squared;
    place = k;
  }
  return place;
}

}  // namespace

void approximate_polygon(std::span<const EdgePoint> points, float tolerance_px, Vertices& vertices) {
  vertices.clear();
  if (points.empty()) return;
  // Ends of the pieces still to be cut, the next one on top; each is another point. Not a StaticVector, which would be
  // cleared for each of many short contours.
  std::array<std::uint16_t, kMaxPolygonPoints> ends;
  std::size_t open = 0;
  std::uint16_t first = 0;
  vertices.push_back(0);
  ends[open++] = static_cast<std::uint16_t>(points.size() - 1);
  while (open > 0) {
    const std::uint16_t cut = farthest(points, first, ends[open - 1], tolerance_px);
    if (cut != 0) {
      ends[open++] = cut;
      continue;
    }
    first = ends[--open];
    if (first != vertices.back()) vertices.push_back(first);
  }
}

}  // namespace pharos::ellipse
