// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tools {

/// One frame for the module: pictures row by row, without gaps.
struct OrbFrame {
  const std::uint16_t* intensity;
  const std::uint16_t* depth;  // 0: none
  std::int32_t width_px;
  std::int32_t height_px;
};

/// fx, fy, cx, cy, k1, k2, p1, p2, k3.
struct OrbCamera {
  double values[9];
  double depth_scale_m;
};

/// What the module offers: how the scene moved in the camera's frame from one frame to the other,
/// p_second = R p_first + t, by ORB features matched between the two (the first one's depth gives them their place) and
/// RANSAC over their reprojections. Rotation row by row. False where too few features agree.
using OrbMotionFunction = bool (*)(const OrbFrame* first, const OrbFrame* second, const OrbCamera* camera,
                                   double* rotation, double* translation_m);

inline constexpr const char* kOrbFunctionName = "pharos_orb_motion";
inline constexpr const char* kOrbModuleName = "libpharos_orb.so";

/// From the module beside this program, or null where it was not built (no OpenCV).
OrbMotionFunction load_orb_motion();

}  // namespace pharos::tools
