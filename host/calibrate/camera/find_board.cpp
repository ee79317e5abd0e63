// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/find_board.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/camera/find_dots.hpp"
#include "host/calibrate/camera/opencv_boards.hpp"

namespace pharos::calibrate {
namespace {

// Fraction of the pixels that the stretch may clip at either end.
constexpr double kClipped = 0.001;
// An edge wider than this fraction of a square's side gives no corner.
constexpr double kMaxEdge = 0.4;

std::vector<std::uint8_t> stretched(GreyView image) {
  std::vector<std::uint16_t> sorted;
  sorted.reserve(image.pixels());
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    sorted.insert(sorted.end(), image.row(v), image.row(v) + image.width_px);
  }
  const auto at_fraction = [&](double fraction) {
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return double{static_cast<double>(*place)};
  };
  const double low = at_fraction(kClipped), high = std::max(at_fraction(1.0 - kClipped), low + 1.0);
  std::vector<std::uint8_t> grey;
  grey.reserve(image.pixels());
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      const double fraction = std::clamp((image.at(u, v) - low) / (high - low), 0.0, 1.0);
      grey.push_back(static_cast<std::uint8_t>(std::lround(255.0 * fraction)));
    }
  }
  return grey;
}

// Rows downwards, then columns to the right.
std::vector<Vector2> in_order(std::vector<Vector2> corners, const Board& board) {
  Vector2 along_column = Vector2::Zero(), along_row = Vector2::Zero();
  for (int row = 0; row < board.rows; ++row)
    along_column += corners[board.index(board.columns - 1, row)] - corners[board.index(0, row)];
  for (int column = 0; column < board.columns; ++column)
    along_row += corners[board.index(column, board.rows - 1)] - corners[board.index(column, 0)];
  if (along_column.x() * along_row.y() - along_column.y() * along_row.x() < 0.0) {
    for (int row = 0; 2 * row < board.rows - 1; ++row) {
      std::swap_ranges(corners.begin() + static_cast<std::ptrdiff_t>(board.index(0, row)),
                       corners.begin() + static_cast<std::ptrdiff_t>(board.index(0, row)) + board.columns,
                       corners.begin() + static_cast<std::ptrdiff_t>(board.index(0, board.rows - 1 - row)));
    }
  }
  if (along_column.x() < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

BoardSearch find_chessboard(GreyView image, const Board& board) {
  const std::vector<std::uint8_t> grey = stretched(image);
  const auto corners = opencv_corners({grey.data(), image.width_px, image.height_px}, board);
  BoardSearch search;
  if (!corners) {
    search.detail = "no chessboard with " + std::to_string(board.columns) + " x " + std::to_string(board.rows) +
                    " inner corners is seen whole";
    return search;
  }
  const std::vector<Vector2> ordered = in_order(corners->pixels, board);
  const Vector2 across = ordered.back() - ordered.front();
  const double side = across.norm() / std::hypot(board.columns - 1, board.rows - 1);
  if (corners->edge_px > kMaxEdge * side) {
    search.status = ImageStatus::kBlurred;
    search.detail = "edges are " + std::to_string(std::lround(corners->edge_px)) + " px wide on squares of " +
                    std::to_string(std::lround(side)) + " px";
    return search;
  }
  search.status = ImageStatus::kUsed;
  for (const Vector2& corner : ordered) search.board.points.push_back({corner, 1.0, 0.0});
  return search;
}

}  // namespace

GreyView first_readable(const std::vector<BoardPicture>& pictures) {
  const auto first = std::find_if(pictures.begin(), pictures.end(), [](const auto& p) { return p.error.empty(); });
  return first == pictures.end() ? GreyView{} : first->image;
}

BoardSearch find_board(GreyView image, const Board& board, DotThreshold threshold) {
  return board.kind == BoardKind::kDots ? find_dots(image, board, threshold) : find_chessboard(image, board);
}

}  // namespace pharos::calibrate
