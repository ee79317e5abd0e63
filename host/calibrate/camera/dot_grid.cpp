// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/dot_grid.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace pharos::calibrate {
namespace {

// Of the usual distance between neighbours; a diagonal is at 1.41.
constexpr double kNearest = 0.7;
constexpr double kFarthest = 1.25;
// A step's deviation from the grid's direction, in steps.
constexpr double kStraight = 0.35;
constexpr std::size_t kMinGrid = 4;

using Cell = std::pair<int, int>;  // column, row
using Grid = std::map<Cell, std::size_t>;

double distance(const Blob& from, const Blob& to) {
  const Vector2 d = to.centre_px - from.centre_px;
  return std::sqrt(std::max(d.dot(from.covariance_px2.inverse() * d), 0.0));
}

std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Blob>& blobs) {
  std::vector<double> nearest(blobs.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    for (std::size_t j = 0; j < blobs.size(); ++j) {
      if (j != i) nearest[i] = std::min(nearest[i], distance(blobs[i], blobs[j]));
    }
  }
  std::vector<double> sorted = nearest;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto is_step = [&](double d) { return d > kNearest * *middle && d < kFarthest * *middle; };
  std::vector<std::vector<std::size_t>> neighbours(blobs.size());
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    for (std::size_t j = 0; j < blobs.size(); ++j) {
      if (j != i && is_step(distance(blobs[i], blobs[j])) && is_step(distance(blobs[j], blobs[i]))) {
        neighbours[i].push_back(j);
      }
    }
  }
  return neighbours;
}

// One dot with its cell, and the local steps along columns and rows.
struct Placed {
  std::size_t blob = 0;
  Cell cell;
  Matrix2 steps;  // columns: to the next column, to the next row
};

// A pair of neighbours at about a right angle (in the metric of the dot's ellipse) spans the grid.
std::optional<Matrix2> steps_at(const std::vector<Blob>& blobs, const std::vector<std::size_t>& neighbours,
                                std::size_t blob) {
  const Matrix2 metric = blobs[blob].covariance_px2.inverse();
  for (const std::size_t a : neighbours) {
    for (const std::size_t b : neighbours) {
      Matrix2 steps;
      steps << blobs[a].centre_px - blobs[blob].centre_px, blobs[b].centre_px - blobs[blob].centre_px;
      const Matrix2 gram = steps.transpose() * metric * steps;
      const double cosine = gram(0, 1) / std::sqrt(gram(0, 0) * gram(1, 1));
      if (std::abs(cosine) < kStraight && steps.determinant() > 0.0) return steps;
    }
  }
  return std::nullopt;
}

Grid grow(const std::vector<Blob>& blobs, const std::vector<std::vector<std::size_t>>& neighbours, std::size_t seed) {
  const std::optional<Matrix2> steps = steps_at(blobs, neighbours[seed], seed);
  if (!steps) return {};
  Grid grid{{{0, 0}, seed}};
  std::vector<bool> taken(blobs.size(), false);
  taken[seed] = true;
  std::vector<Placed> queue{{seed, {0, 0}, *steps}};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Placed from = queue[next];
    for (const std::size_t to : neighbours[from.blob]) {
      if (taken[to]) continue;
      const Vector2 step = blobs[to].centre_px - blobs[from.blob].centre_px;
      const Vector2 way = from.steps.inverse() * step;
      const Vector2 whole(std::round(way.x()), std::round(way.y()));
      if (whole.cwiseAbs().sum() != 1.0 || (way - whole).norm() > kStraight) continue;
      const Cell cell{from.cell.first + static_cast<int>(whole.x()), from.cell.second + static_cast<int>(whole.y())};
      if (!grid.emplace(cell, to).second) continue;
      taken[to] = true;
      Placed placed{to, cell, from.steps};
      placed.steps.col(whole.x() != 0.0 ? 0 : 1) = step * whole.sum();
      queue.push_back(placed);
    }
  }
  return grid;
}

// Every dot belongs to one grid at most, so the search from any dot of a grid finds all of it.
Grid largest_grid(const std::vector<Blob>& blobs) {
  const auto neighbours = neighbours_of(blobs);
  Grid best;
  std::vector<bool> tried(blobs.size(), false);
  for (std::size_t seed = 0; seed < blobs.size(); ++seed) {
    if (tried[seed] || neighbours[seed].size() < 2) continue;
    Grid grid = grow(blobs, neighbours, seed);
    for (const auto& [cell, blob] : grid) tried[blob] = true;
    if (grid.size() > best.size()) best = std::move(grid);
  }
  return best;
}

struct Extent {
  int first_column = 0, first_row = 0, columns = 0, rows = 0;
};

Extent extent_of(const Grid& grid) {
  Extent extent{grid.begin()->first.first, grid.begin()->first.second, 0, 0};
  int last_column = extent.first_column, last_row = extent.first_row;
  for (const auto& [cell, blob] : grid) {
    extent.first_column = std::min(extent.first_column, cell.first);
    extent.first_row = std::min(extent.first_row, cell.second);
    last_column = std::max(last_column, cell.first);
    last_row = std::max(last_row, cell.second);
  }
  extent.columns = last_column - extent.first_column + 1;
  extent.rows = last_row - extent.first_row + 1;
  return extent;
}

// A quarter turn: columns become rows, still right-handed.
Grid turned(const Grid& grid) {
  Grid result;
  for (const auto& [cell, blob] : grid) result.emplace(Cell{cell.second, -cell.first}, blob);
  return result;
}

// Sum of the steps along columns, to the right in the image.
double rightward(const Grid& grid, const std::vector<Blob>& blobs) {
  double sum = 0.0;
  for (const auto& [cell, blob] : grid) {
    const auto next = grid.find({cell.first + 1, cell.second});
    if (next != grid.end()) sum += blobs[next->second].centre_px.x() - blobs[blob].centre_px.x();
  }
  return sum;
}

std::string times(int columns, int rows) { return std::to_string(columns) + " x " + std::to_string(rows); }

// A dot beyond the grid's edge would be outside the image or on its border.
bool reaches_border(const Grid& grid, const std::vector<Blob>& blobs, int width_px, int height_px) {
  constexpr std::array<Cell, 4> kWays{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (const auto& [cell, blob] : grid) {
    if (blobs[blob].cut) return true;
    for (const auto& [dc, dr] : kWays) {
      const auto before = grid.find({cell.first - dc, cell.second - dr});
      if (grid.count({cell.first + dc, cell.second + dr}) != 0 || before == grid.end()) continue;
      const Vector2 beyond = 2.0 * blobs[blob].centre_px - blobs[before->second].centre_px;
      if (beyond.x() < 0.0 || beyond.y() < 0.0 || beyond.x() > width_px - 1 || beyond.y() > height_px - 1) return true;
    }
  }
  return false;
}

DotGrid incomplete(const Grid& grid, const std::vector<Blob>& blobs, const Board& board, int width_px, int height_px) {
  DotGrid result;
  result.found = grid.size();
  const Extent extent = extent_of(grid);
  const std::string seen = "a grid of " + times(extent.columns, extent.rows) + " of the board's " +
                           times(board.columns, board.rows) + " dots is seen";
  if (grid.size() > board.size()) {
    result.status = ImageStatus::kTooMany;
    result.detail = seen + "; check --columns and --rows";
  } else if (reaches_border(grid, blobs, width_px, height_px)) {
    result.status = ImageStatus::kPartlyOutside;
    result.detail = seen + ", up to the image's border";
  } else {
    result.status = ImageStatus::kIncomplete;
    result.detail = seen;
  }
  return result;
}

DotGrid in_board_order(const Grid& grid, const Extent& extent, const std::vector<Blob>& blobs, const Board& board) {
  DotGrid result;
  result.found = grid.size();
  std::string missing;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const auto at = grid.find({extent.first_column + column, extent.first_row + row});
      if (at != grid.end()) {
        result.blob.push_back(at->second);
        result.status = blobs[at->second].cut ? ImageStatus::kPartlyOutside : result.status;
      } else if (missing.empty()) {
        missing = "the dot in column " + std::to_string(column + 1) + ", row " + std::to_string(row + 1) +
                  " as seen is missing";
      }
    }
  }
  const std::size_t gone = board.size() - result.blob.size();
  if (gone > 1) missing += ", and " + std::to_string(gone - 1) + " more";
  if (gone > 0) {
    result.status = ImageStatus::kIncomplete;
    result.detail = missing;
  } else if (result.status == ImageStatus::kPartlyOutside) {
    result.detail = "a dot lies on the image's border";
  } else {
    result.status = ImageStatus::kUsed;
  }
  return result;
}

}  // namespace

DotGrid find_dot_grid(const std::vector<Blob>& blobs, const Board& board, int width_px, int height_px) {
  DotGrid none;
  none.detail = std::to_string(blobs.size()) + " dots in no grid";
  if (blobs.size() < kMinGrid) return none;
  Grid grid = largest_grid(blobs);
  if (grid.size() < kMinGrid) return none;
  Extent extent = extent_of(grid);
  if (extent.columns != board.columns ||
      (board.columns == board.rows && std::abs(rightward(grid, blobs)) < std::abs(rightward(turned(grid), blobs)))) {
    grid = turned(grid);
    extent = extent_of(grid);
  }
  if (extent.columns != board.columns || extent.rows != board.rows) {
    return incomplete(grid, blobs, board, width_px, height_px);
  }
  if (rightward(grid, blobs) < 0.0) {
    grid = turned(turned(grid));
    extent = extent_of(grid);
  }
  return in_board_order(grid, extent, blobs, board);
}

}  // namespace pharos::calibrate
