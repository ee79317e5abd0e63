// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/static_vector.hpp"
#include "pharos/ellipse/edge_point.hpp"

namespace pharos::ellipse {

/// Maximum points of one contour that become one polygon: longer contours are cut. Limits the time of the worst
/// contour.
inline constexpr std::uint32_t kMaxPolygonPoints = 4096;

/// Indices of vertices, first and last point included.
using Vertices = StaticVector<std::uint16_t, kMaxPolygonPoints>;

/// Douglas and Peucker's polygon: every point within `tolerance_px` of it. At most kMaxPolygonPoints points.
void approximate_polygon(std::span<const EdgePoint> points, float tolerance_px, Vertices& vertices);

}  // namespace pharos::ellipse
