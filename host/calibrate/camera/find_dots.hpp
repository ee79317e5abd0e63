// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/calibrate/camera/blobs.hpp"
#include "host/calibrate/camera/board.hpp"
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

/// Finds a board of dots, bright ones on dark or dark ones on bright, and the centre of each dot's image. About 0.1 s
/// for 640x480. `threshold` decides which spots are tried; centres are fitted to the grey values either way.
BoardSearch find_dots(GreyView image, const Board& board, DotThreshold threshold = DotThreshold::kLocal);

}  // namespace pharos::calibrate
