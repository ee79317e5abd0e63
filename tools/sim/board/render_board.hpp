// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::sim {

/// A lens as papers print it: OpenCV's order of coefficients, implemented here on its own (README.md).
struct Lens {
  int width_px = 640;
  int height_px = 480;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3
};

/// Where a point in the camera's frame is seen; the pixel (0, 0) is the centre of the first.
std::array<double, 2> pixel_of(const Lens& lens, const Vector3& point_camera_m);

/// What paper 000 prints in table 1.
inline constexpr Lens kPaperLens{640, 480, 608.61, 605.04, 321.85, 238.94, {-0.1991, 0.0809, 0.0021, -0.0002, 0.0}};

/// A flat board: x along its columns, y along its rows, z away from who looks at it; the origin is the first dot or the
/// first inner corner.
struct BoardSheet {
  bool dots = true;  // else a chessboard
  int columns = 12;  // dots, or inner corners
  int rows = 8;
  double pitch_m = 0.02;
  double radius_m = 0.005;
  int missing = -1;  // a dot that is not there: row * columns + column
};

/// What the light and the sensor make of it, in counts.
struct Exposure {
  double dark = 2000.0;  // the sheet, or the dark squares
  double bright = 30000.0;
  double surround = 1000.0;  // beyond the sheet's margin
  double blur_px = 0.5;      // of the optics, Gaussian; the pixels' own width comes on top
  double noise = 0.0;        // 1 sigma of each pixel
  double falloff = 0.0;      // share of the light that is missing at the image's corners
  int bits = 16;
};

struct BoardImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> pixels;
};

/// Renders boards through one lens. Making it undistorts the grid of pixel corners once.
class BoardRenderer {
 public:
  explicit BoardRenderer(const Lens& lens);

  /// The board at T_camera_board. A pixel that an edge crosses is the mean of 1024 rays over its own width
  /// and the optics' blur. About 0.3 s for 640x480.
  BoardImage render(const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T_camera_board,
                    const Exposure& exposure, std::uint64_t seed) const;

 private:
  Lens lens_;
  std::vector<std::array<double, 2>> corner_;  // ideal ray x/z, y/z of each pixel's upper left corner
};

}  // namespace pharos::sim
