// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::pointing {

/// The border of the module that holds OpenCV's line segment detector: plain types only.
///
/// Finds segments in an 8-bit image without gaps between its rows; writes up to `most` of them as u1, v1, u2, v2 (px)
/// and returns how many; -1 where OpenCV threw. `scale`: the image is looked at so many times as large, 0.8 usually.
using LsdFunction = int (*)(const std::uint8_t* image, std::int32_t width_px, std::int32_t height_px, double scale,
                            float* segments, int maximum);
inline constexpr const char* kLsdModuleName = "libpharos_opencv_lsd.so";
inline constexpr const char* kLsdModuleFunction = "pharos_opencv_lsd";

}  // namespace pharos::pointing
