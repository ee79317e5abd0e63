// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/sim/board/render_board.hpp"

namespace pharos::sim {

/// Poses as somebody holds a board who was told how: all over the image, tilted up to 40 degrees every way, near and
/// far, the whole board seen.
std::vector<Pose<frame::Camera, frame::Board>> board_poses(const Lens& lens, const BoardSheet& sheet, int count,
                                                           std::uint64_t seed);

/// Whether the image holds the whole sheet, its margin included.
bool shows_all_of(const Lens& lens, const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T_camera_board);

/// The board's middle at `middle_m`, turned by `roll_rad` about the line of sight and then tilted by the rotation
/// vector `tilt_rad` about its middle.
Pose<frame::Camera, frame::Board> board_at(const BoardSheet& sheet, const Vector3& middle_m, const Vector3& tilt_rad,
                                           double roll_rad = 0.0);

}  // namespace pharos::sim
