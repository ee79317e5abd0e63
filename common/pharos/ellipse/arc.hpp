// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::ellipse {

struct PointF {
  float u = 0.0F;
  float v = 0.0F;
};

/// Points of an arc, evenly spread, for comparison and fits before all its points are used.
inline constexpr int kArcSamples = 16;

/// A piece of contour of one sign of curvature, without a corner.
///
/// Contours run with the brighter side on the right (gradient rotated by +90 deg, from +u towards +v), so the sign of
/// the curvature shows which side is bright: turn_rad < 0 curves around brightness.
struct Arc {
  std::uint32_t begin = 0;  ///< its points in the ordered list: [begin, end)
  std::uint32_t end = 0;
  float turn_rad = 0.0F;  ///< angle between the tangents of its two ends, signed
  PointF start, middle, finish;
  PointF start_tangent, finish_tangent;  ///< unit vectors along the contour
  std::array<PointF, kArcSamples> samples{};
  std::array<PointF, kArcSamples> normals{};  ///< unit gradients at the samples
  PointF about;                               ///< all its points lie within `radius_px` of here
  float radius_px = 0.0F;
  bool seed = false;  /// long and curved enough to propose an ellipse; others only support one

  std::uint32_t points() const { return end - begin; }
};

}  // namespace pharos::ellipse
