// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"

namespace pharos::calibrate {

/// How many ways a board of dots, or of squares, may be turned and look the same: 2, or 4 where it is square.
int turns_of(const Board& board);

/// The same image with the board labelled as if it were turned by `turns` quarter turns (square boards) or half turns.
FoundBoard turned(const FoundBoard& found, const Board& board, int turns);

/// T_camera_board for the board so labelled.
CameraFromBoard turned(const CameraFromBoard& T_camera_board, const Board& board, int turns);

/// For each view, the turn of the right board with which left and right see one board from two cameras that are fixed
/// to each other.
std::vector<int> matching_turns(const std::vector<CameraFromBoard>& left, const std::vector<CameraFromBoard>& right,
                                const Board& board);

}  // namespace pharos::calibrate
