// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/blobs.hpp"
#include "host/calibrate/camera/board.hpp"
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

/// The blobs that form the board's grid, or why there is none.
struct DotGrid {
  ImageStatus status = ImageStatus::kNoBoard;
  std::string detail;
  std::vector<std::size_t> blob;  // of each board point in the board's order; complete when status is kUsed
  std::size_t found = 0;          // dots in the largest grid: the score of an attempt
};

/// Finds the largest grid among the blobs. In the metric of its own ellipse the neighbours of each dot are at the same
/// distance and at right angles, whatever the perspective; the grid grows from neighbour to neighbour, and its columns
/// are turned to run to the right in the image, its rows so that x, y, z are right-handed with z away from the camera.
DotGrid find_dot_grid(const std::vector<Blob>& blobs, const Board& board, int width_px, int height_px);

}  // namespace pharos::calibrate
