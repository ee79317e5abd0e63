// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/camera/board.hpp"
#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::calibrate {

using CameraFromBoard = Pose<frame::Camera, frame::Board>;

/// Where a board's point is seen: a corner at its own image; a dot at the centroid of its disk's image, because neither
/// perspective nor lens take the centre of the disk there. Sums sixteen points of the disk, each with the area that it
/// takes in the image (exact for terms of the third degree across the dot).
struct ProjectedPoint {
  Vector2 pixel = Vector2::Zero();
  double area_px2 = 0.0;  // of a dot
};
ProjectedPoint project_board_point(const PinholeCamera& camera, const CameraFromBoard& T_camera_board,
                                   const Board& board, std::size_t index);

}  // namespace pharos::calibrate
