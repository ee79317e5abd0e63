// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/base/static_vector.hpp"
#include "pharos/ellipse/arc.hpp"
#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/edge_point.hpp"

namespace pharos::ellipse {

/// Maximum edge points stored of one image: twice those of the busiest rendered frame of 640x480. More are counted; the
/// thresholds rise before that happens.
inline constexpr std::size_t kMaxEdgePoints = 40960;
/// Maximum arcs stored of one image: three calibration sheets of 70 rings, two edges each, in a few pieces.
inline constexpr std::size_t kMaxArcs = 2048;
/// Maximum ellipses returned of one image, the best by score: three sheets of 70 rings, two edges each.
inline constexpr std::size_t kMaxEllipses = 512;
/// Planes of 16 bits a pixel lent by the caller: the smoothed image, gradient magnitude, indices of edge points.
inline constexpr std::size_t kPlanes = 3;
/// Narrower or lower images are too small for an edge with its surroundings.
inline constexpr std::int32_t kMinSide_px = 8;
/// Edges so near to the border are not used: smoothing reaches 2 px and the difference one more, so beyond the border
/// pixels that do not exist would bend them.
inline constexpr std::int32_t kBorder_px = 3;
/// Wider or higher images would not fit an edge point's column and row, nor the steps of its arithmetic.
inline constexpr std::int32_t kMaxSide_px = 32767;

/// Counters of the last image.
struct EllipseCounters {
  std::uint32_t edge_points = 0;
  std::uint32_t edge_points_dropped = 0;
  std::uint32_t contours = 0;
  std::uint32_t contours_dropped = 0;
  std::uint32_t arcs = 0;
  std::uint32_t arcs_dropped = 0;
  std::uint32_t candidates = 0;
  std::uint32_t ellipses_dropped = 0;
};

static_assert(kMaxArcs % kArcSamples == 0, "arcs are asked for in whole blocks");

/// Circles around the arcs, side by side: which arcs may touch a contour is asked for several at once.
struct ArcBounds {
  std::array<float, kMaxArcs> u_px{}, v_px{}, radius_px{};
};

/// All memory of the detection except the stack; the caller owns both parts.
struct EllipseWorkspace {
  /// `planes` holds kPlanes * width * height values of the largest image expected.
  explicit EllipseWorkspace(std::span<std::uint16_t> planes_of_caller) : planes(planes_of_caller) {}

  std::span<std::uint16_t> planes;
  std::int32_t width_px = 0;  ///< of the last image; 0: unbounded
  std::int32_t height_px = 0;
  float noise = 0.0F;  ///< sigma of the last image's gradient, each component, in the edge points' unit
  EllipseCounters counters;

  StaticVector<EdgePoint, kMaxEdgePoints> edges;    ///< as found, row by row
  StaticVector<EdgePoint, kMaxEdgePoints> ordered;  ///< along contours; arcs are ranges of it
  std::array<std::uint16_t, kMaxEdgePoints> order{};
  StaticVector<Arc, kMaxArcs> arcs;
  ArcBounds bounds;  ///< of `arcs`, by find_arcs
  StaticVector<DetectedEllipse, kMaxEllipses> found;
};

}  // namespace pharos::ellipse
