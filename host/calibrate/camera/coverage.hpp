// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

/// Distribution of the points over the image.
struct Coverage {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;
  std::array<std::array<int, kColumns>, kRows> points{};  // in each cell
  double fraction = 0.0;                                  // of the cells that hold a point
  double reach = 0.0;  // distance of the farthest point from the image's centre, over that of the corners
  std::vector<std::string> uncovered;  // ninths of the image without a point, in words: "upper left", …
};
Coverage coverage_of(const std::vector<FoundBoard>& views, int width_px, int height_px);

}  // namespace pharos::calibrate
