// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::calibrate {

using GreyView = ImageView<const std::uint16_t>;

/// A board's point in an image.
struct FoundPoint {
  Vector2 pixel = Vector2::Zero();
  double sigma_px = 1.0;  // each axis; of corners only in proportion to each other
  double area_px2 = 0.0;  // of a dot
};

/// All of a board's points, in the board's order (row by row). Where a board looks the same after half a turn (a
/// quarter, if it is square), the labels may be turned by that.
struct FoundBoard {
  std::vector<FoundPoint> points;
};

/// Outcome of an image.
enum class ImageStatus : std::uint8_t {
  kUsed,
  kNoBoard,
  kPartlyOutside,
  kIncomplete,  // the board is in the image, but points of it are missing
  kTooMany,     // more points in a grid than the board has
  kBlurred,
  kTooSmall,
  kOtherSize,  // than the first image
  kNoPartner,  // the other image of its pair was not used
  kUnreadable,
};
/// used, no_board, partly_outside, …
const char* name_of(ImageStatus status);

/// A board, or why there is none.
struct BoardSearch {
  ImageStatus status = ImageStatus::kNoBoard;
  std::string detail;  // message for the user: "dot in column 3, row 5 is missing"; empty when used
  FoundBoard board;    // when used
};

}  // namespace pharos::calibrate
