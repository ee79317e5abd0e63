// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/images/grey_image.hpp"
#include "pharos/geometry/pose.hpp"
#include "tools/sim/optics/ray_grid.hpp"

namespace pharos::sim {

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
  double falloff = 0.0;      // fraction of the light that is missing at the image's corners
  int bits = 16;
};

/// Renders boards through one lens. Making it undistorts the grid of pixel corners once.
class BoardRenderer {
 public:
  explicit BoardRenderer(const Lens& lens) : lens_(lens), corners_(RayGrid::pixel_corners(lens)) {}

  /// The board at T_camera_board; values as read_grey_image gives them (8 bits: count * 257). A pixel that an edge
  /// crosses is the mean of 1024 rays over its own width and the optics' blur. About 0.3 s for 640x480.
  host::GreyImage render(const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T_camera_board,
                         const Exposure& exposure, std::uint64_t seed) const;

 private:
  Lens lens_;
  RayGrid corners_;  // of the pixels
};

}  // namespace pharos::sim
