// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tools {

/// What the peers' module offers for dark images. Grey images of 8 bits without gaps, one thread; false on an error.
struct LowLightPeers {
  /// fastNlMeansDenoising, windows of 7 and 21 pixels.
  bool (*non_local_means)(const std::uint8_t* in, int width_px, int height_px, float strength, std::uint8_t* out);
  /// CLAHE, limit 4, 8 x 8 tiles.
  bool (*clahe)(const std::uint8_t* in, int width_px, int height_px, std::uint8_t* out);
  /// Retinex at the scales 15, 80 and 250 px with equal weights, stretched from 1 to 99 %.
  bool (*multi_scale_retinex)(const std::uint8_t* in, int width_px, int height_px, std::uint8_t* out);
  /// 1000 ORB features each, matched across and back; how many agree with one fundamental matrix (RANSAC, 1 px).
  int (*inliers)(const std::uint8_t* first, const std::uint8_t* second, int width_px, int height_px);
};

/// Name of the function that gives them.
inline constexpr const char* kLowLightPeersName = "pharos_bench_low_light";
using LowLightPeersFunction = const LowLightPeers* (*)();

}  // namespace pharos::tools
