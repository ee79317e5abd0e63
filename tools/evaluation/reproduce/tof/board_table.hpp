// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Table 1: `images` rendered pictures of the dot board, and as many of the chessboard, through the paper's lens. About
/// half a second an image.
std::vector<ComparisonRow> reproduce_board_table(int images, std::uint64_t seed);

}  // namespace pharos::tools
