// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/find_dots.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "host/calibrate/camera/dot_grid.hpp"
#include "host/calibrate/camera/fit_dot.hpp"

namespace pharos::calibrate {
namespace {

// Of the image's shorter side: a window must hold a dot with its surround, and should hold little beyond the board.
constexpr std::array<int, 3> kWindows{6, 12, 24};
constexpr int kMinWindow_px = 9;
// An edge this wide, in minor semi-axes, leaves no plateau that shows the dot's brightness.
constexpr double kMaxBlur = 0.6;
constexpr double kMinAxis_px = 1.8;
// Largest scatter of grey values around a dot's fit, as a fraction of the contrast.
constexpr double kMaxMisfit = 0.15;
// The fit uses pixels up to this fraction of the gap to the next dot, whose own edge is at 1.
constexpr double kReachOfGap = 0.5;
constexpr double kMaxReach = 2.2;

std::string decimal(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

std::string dot(const Board& board, std::size_t index) {
  return "the dot in column " + std::to_string(board.column_of(index) + 1) + ", row " +
         std::to_string(board.row_of(index) + 1) + " as seen ";
}

BoardSearch refused(ImageStatus status, std::string detail) { return {status, std::move(detail), {}}; }

// One attempt at one window and brightness.
struct Attempt {
  std::vector<Blob> blobs;
  DotGrid grid;
};

Attempt attempt(GreyView image, const Board& board, std::vector<Blob> blobs) {
  Attempt result;
  result.blobs = std::move(blobs);
  result.grid = find_dot_grid(result.blobs, board, image.width_px, image.height_px);
  return result;
}

// Better of two; `now` where it has the board.
void take_better(Attempt& best, Attempt now) {
  if (now.grid.status == ImageStatus::kUsed || now.grid.found > best.grid.found) best = std::move(now);
}

Attempt attempt_by_otsu(GreyView image, const Board& board) {
  Attempt best;
  best.grid.detail = "no dots";
  for (const bool bright : {true, false}) {
    if (best.grid.status == ImageStatus::kUsed) break;
    take_better(best, attempt(image, board, find_blobs_by_otsu(image, bright)));
  }
  return best;
}

Attempt best_attempt(GreyView image, const Board& board) {
  Attempt best;
  best.grid.detail = "no dots";
  for (const int fraction : kWindows) {
    const int window_px = std::max(std::min(image.width_px, image.height_px) / fraction, kMinWindow_px);
    for (const bool bright : {true, false}) {
      take_better(best, attempt(image, board, find_blobs(image, window_px, bright)));
      if (best.grid.status == ImageStatus::kUsed) return best;
    }
  }
  return best;
}

}  // namespace

BoardSearch find_dots(GreyView image, const Board& board, DotThreshold threshold) {
  const Attempt found = threshold == DotThreshold::kOtsu ? attempt_by_otsu(image, board) : best_attempt(image, board);
  if (found.grid.status != ImageStatus::kUsed) return refused(found.grid.status, found.grid.detail);
  const double gap = board.pitch_m / board.radius_m - 2.0;  // between two dots' edges, in radii
  const double reach = std::min(1.0 + kReachOfGap * gap, kMaxReach);
  BoardSearch search;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const auto fit = fit_dot(image, found.blobs[found.grid.blob[i]], reach);
    if (!fit) return refused(ImageStatus::kIncomplete, dot(board, i) + "has no outline of a dot");
    if (fit->minor_px < kMinAxis_px) {
      return refused(ImageStatus::kTooSmall, dot(board, i) + "has a radius of " + decimal(fit->minor_px) +
                                                 " px, too few to measure; go nearer");
    }
    if (fit->blur_px > kMaxBlur * fit->minor_px) {
      return refused(ImageStatus::kBlurred, dot(board, i) + "has edges " + decimal(fit->blur_px) +
                                                " px wide on a radius of " + decimal(fit->minor_px) + " px");
    }
    if (fit->misfit > kMaxMisfit) {
      return refused(ImageStatus::kIncomplete, dot(board, i) + "does not look like one (" +
                                                   decimal(100.0 * fit->misfit) + " % of its contrast off it)");
    }
    search.board.points.push_back({fit->centre_px, fit->sigma_px, fit->area_px2});
  }
  search.status = ImageStatus::kUsed;
  return search;
}

}  // namespace pharos::calibrate
