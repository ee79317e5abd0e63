// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::tof {

/// One frame of the depth camera: two images of one pixel grid, raw and distorted.
struct TofFrame {
  /// Amplitude of the returned light, linear.
  ImageView<const std::uint16_t> intensity;
  /// Cartesian Z in counts of DepthCamera::depth_scale_m; 0 or 65535 = no depth.
  ImageView<const std::uint16_t> depth;
};

/// Largest frame: the Helios' own, 640 x 480. Every plane of the workspace has this many pixels.
inline constexpr std::int32_t kMaxWidth_px = 640;
inline constexpr std::int32_t kMaxHeight_px = 480;
inline constexpr std::int32_t kMaxPixels = kMaxWidth_px * kMaxHeight_px;

}  // namespace pharos::tof
