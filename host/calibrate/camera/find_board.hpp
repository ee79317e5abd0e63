// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/blobs.hpp"
#include "host/calibrate/camera/board.hpp"
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

/// An image and its name. Does not own the pixels; there are none where the image could not be read.
struct BoardPicture {
  std::string name;
  GreyView image;
  std::string error = {};  // why it could not be read; empty where it could
};

/// The first image that could be read: the others must have its size. Empty where none could.
GreyView first_readable(const std::vector<BoardPicture>& pictures);

/// Finds `board`. Points run to the right along the columns and down along the rows as far as the board's symmetry
/// permits: a board of dots, and a chessboard of even squares, look the same after half a turn. Chessboards: OpenCV's
/// corners on the grey values stretched to 8 bit. `threshold` is for dots.
BoardSearch find_board(GreyView image, const Board& board, DotThreshold threshold = DotThreshold::kLocal);

}  // namespace pharos::calibrate
