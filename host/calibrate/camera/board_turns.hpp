// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"

namespace pharos::calibrate {

/// Number of rotations that leave the look of a board unchanged: 2, or 4 where it is square.
int turns_of(const Board& board);

/// The same image with the board labelled as if it were turned by `turns` quarter turns (square boards) or half turns.
FoundBoard turned(const FoundBoard& found, const Board& board, int turns);

/// T_camera_board for the board so labelled.
CameraFromBoard turned(const CameraFromBoard& T_camera_board, const Board& board, int turns);

/// For each view, the turn of the right board for which both images show one board from two cameras with a fixed
/// relative pose.
std::vector<int> matching_turns(const std::vector<CameraFromBoard>& left, const std::vector<CameraFromBoard>& right,
                                const Board& board);

}  // namespace pharos::calibrate
