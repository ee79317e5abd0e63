// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::calibrate {

// The border between the program and its module: plain numbers only, so that neither needs the other's libraries.
// Pixels u, v in turn; optics fx, fy, cx, cy, k1, k2, p1, p2, k3; poses as rotation (row by row) and translation.

struct ModuleViews {
  int views;
  int points;           // of each view
  const double* board;  // x, y, z of each point
  int width_px;
  int height_px;
  bool fix_k3;
};

struct OpencvModule {
  bool (*find_corners)(const std::uint8_t* image, int width_px, int height_px, int columns, int rows, double* pixels,
                       double* edge_px);
  bool (*calibrate)(const ModuleViews& views, const double* pixels, double* intrinsics, double* poses, double* rms_px);
  /// optics: 9 of the left, 9 of the right; pose: T_right_left.
  bool (*calibrate_stereo)(const ModuleViews& views, const double* left, const double* right, double* intrinsics,
                           double* pose, double* rms_px);
};

inline constexpr const char* kOpencvModuleName = "libpharos_opencv_boards.so";
inline constexpr const char* kOpencvModuleFunction = "pharos_opencv_boards";
using OpencvModuleFunction = const OpencvModule* (*)();

}  // namespace pharos::calibrate
