// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/depth_plane.hpp"

namespace pharos::tof {

/// A rectangle of pixels of the frame: where the connector is searched.
struct PixelRect {
  std::int32_t u = 0;
  std::int32_t v = 0;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

/// G of (5): heights over the ring's plane, which grow towards the camera as (5) requires, whatever the ring's tilt.
inline constexpr double kHeightUnit_m = 0.00025;
/// Count of a point on the plane.
inline constexpr std::int32_t kHeightZero = 32768;
/// Pixels farther from the plane (a boom before the ring, space behind it) are not part of a connector and get no
/// height: they would shift the local mean.
inline constexpr double kMaxHeight_m = 0.25;
/// Count of a pixel without depth, or too far from the plane.
inline constexpr std::uint16_t kNoHeight = 0;

inline double height_of(std::uint16_t counts) { return (counts - kHeightZero) * kHeightUnit_m; }

/// Heights of the frame's pixels inside `rect`; `heights` has its size.
void make_heights(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const DepthPlane& plane,
                  const PixelRect& rect, ImageView<std::uint16_t> heights);

}  // namespace pharos::tof
