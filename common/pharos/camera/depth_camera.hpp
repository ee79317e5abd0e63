// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/camera/pinhole_camera.hpp"

namespace pharos {

/// A camera whose pixels also measure Cartesian depth Z, in the raw (distorted) pixel grid.
struct DepthCamera {
  PinholeCamera intrinsics;
  /// Metres per count of depth; the Helios' own unit is 0.25 mm.
  double depth_scale_m = 0.00025;
  /// Origin of depth on frame C's z axis: 0 is the optical centre, the Helios counts from its front.
  double depth_origin_z_m = 0.0;
  /// Coord3D_ABCY16: metres = count * scale + offset, for X, Y, Z.
  std::array<double, 3> scale_m{0.00025, 0.00025, 0.00025};
  std::array<double, 3> offset_m{};
};

/// Counts of a pixel without depth.
inline constexpr std::uint16_t kNoDepthLow = 0;
inline constexpr std::uint16_t kNoDepthHigh = 65535;

inline constexpr bool has_depth(std::uint16_t counts) { return counts != kNoDepthLow && counts != kNoDepthHigh; }

/// Z in frame C, m, of a count that has_depth.
inline double depth_z_m(const DepthCamera& camera, double counts) {
  return counts * camera.depth_scale_m + camera.depth_origin_z_m;
}

}  // namespace pharos
