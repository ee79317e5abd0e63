// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/camera/board.hpp"
#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::calibrate {

using CameraFromBoard = Pose<frame::Camera, frame::Board>;

/// Image of a board's point: a corner's own image; for a dot the centroid of its disk's image, because under
/// perspective and distortion that is not the image of the disk's centre. Sums sixteen points of the disk, each
/// weighted with its area in the image (exact for terms of the third degree across the dot).
struct ProjectedPoint {
  Vector2 pixel = Vector2::Zero();
  double area_px2 = 0.0;  // of a dot
};
ProjectedPoint project_board_point(const PinholeCamera& camera, const CameraFromBoard& T_camera_board,
                                   const Board& board, std::size_t index);

}  // namespace pharos::calibrate
