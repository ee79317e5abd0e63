// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace pharos::pointing {
namespace {

// A piece farther off the longest one's line than chance explains once in 40,000, and than this, is of another edge.
constexpr double kMaxOffSigmas = 4.2;
// What blur and the renderer's or the sensor's pixels leave between pieces of one edge.
constexpr double kOffSlack_px = 0.05;

// What blur and pixels leave of a step; how certain it must be, and of how many points a part must be. The place is the
// best of hundreds, and the scatter's correlation is uncertain where a panel's cells make it long: at six sigmas a
// straight side was cut (6.5), steps of faces behind a side are nine and more.
constexpr double kMinStep_px = 0.1;
constexpr double kStepSigmas = 8.0;
constexpr std::size_t kMinPart = 20;

using Piece = std::span<const EdgePoint>;

std::vector<Piece> pieces_of(const std::vector<EdgePoint>& points) {
  std::vector<Piece> pieces;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= points.size(); ++k) {
    if (k < points.size() && (points[k].place_px - points[k - 1].place_px).norm() < kEdgeGap_px) continue;
    pieces.emplace_back(points.data() + begin, k - begin);
    begin = k;
  }
  return pieces;
}

// The mean offset of a piece from a line, and its variance by the line's covariance and the points' scatter.
bool belongs(const Piece& piece, const LineFit& line, double structure_px) {
  double off_px = 0.0;
  Vector2 middle = Vector2::Zero();
  const auto count = static_cast<double>(piece.size());
  for (const EdgePoint& point : piece) {
    off_px += line.offset_px(point.place_px) / count;
    middle += point.place_px / count;
  }
  const Vector3 place(middle.x(), middle.y(), 1.0);
  const double variance =
      place.dot(line.line.covariance * place) + line.rms_px * line.rms_px * line.variance_inflation / count;
  return std::abs(off_px) < kMaxOffSigmas * std::sqrt(variance) + structure_px + kOffSlack_px;
}

// Offsets from the line of least squares through all points, by the place along it.
struct Offsets {
  Vector2 across;
  std::vector<double> along, off;  // along: from the points' middle
  double spread = 0.0;             // sum of squares of `along`
};

Offsets offsets_of(const std::vector<EdgePoint>& points, const LineFit& fit) {
  Offsets result{fit.line.coefficients.head<2>(), {}, {}, 0.0};
  const Vector2 direction(result.across.y(), -result.across.x());
  const auto count = static_cast<double>(points.size());
  double middle = 0.0, mean = 0.0;
  for (const EdgePoint& point : points) {
    result.along.push_back(direction.dot(point.place_px));
    result.off.push_back(fit.offset_px(point.place_px));
    middle += result.along.back() / count;
    mean += result.off.back() / count;
  }
  double product = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.along[i] -= middle;
    result.spread += result.along[i] * result.along[i];
    product += result.along[i] * result.off[i];
  }
  for (std::size_t i = 0; i < points.size(); ++i) result.off[i] -= mean + product / result.spread * result.along[i];
  return result;
}

struct Step {
  std::size_t at = 0;  // the first point beyond it
  double height_px = 0.0;
  double information = 0.0;  // of the height, for points of unit variance
};

// Of all places the one where a step explains most of the scatter, with the line's offset and slope free.
Step largest_step(const Offsets& points) {
  const std::size_t n = points.off.size();
  Step best;
  double explained = 0.0, sum = 0.0, moment = 0.0;  // of the points before the step
  for (std::size_t k = 0; k + kMinPart <= n; ++k) {
    if (k >= kMinPart) {
      const auto before = static_cast<double>(k), count = static_cast<double>(n);
      const double information = before * (count - before) / count - moment * moment / points.spread;
      if (sum * sum > explained * information) {
        explained = sum * sum / information;
        best = {k, -sum / information, information};
      }
    }
    sum += points.off[k];
    moment += points.along[k];
  }
  return best;
}

}  // namespace

bool keep_one_edge(std::vector<EdgePoint>& points, double structure_px, double corner_px) {
  std::vector<Piece> pieces = pieces_of(points);
  if (pieces.size() < 2) return false;
  const Piece longest = *std::max_element(pieces.begin(), pieces.end(),
                                          [](const Piece& a, const Piece& b) { return a.size() < b.size(); });
  const auto line = fit_line(longest);
  if (!line) return false;
  std::vector<EdgePoint> kept;
  for (const Piece& piece : pieces) {
    if (piece.data() == longest.data() || belongs(piece, *line, structure_px)) {
      kept.insert(kept.end(), piece.begin(), piece.end());
    }
  }
  if (kept.size() == points.size()) return false;
  const Vector2 begin = kept.front().place_px, end = kept.back().place_px;
  const bool is_begin = begin == points.front().place_px, is_end = end == points.back().place_px;
  std::erase_if(kept, [&](const EdgePoint& point) {
    return (!is_begin && (point.place_px - begin).norm() < corner_px) ||
           (!is_end && (point.place_px - end).norm() < corner_px);
  });
  points = std::move(kept);
  return true;
}

bool keep_one_part(std::vector<EdgePoint>& points) {
  const auto line = fit_line(points);
  if (!line || points.size() < 2 * kMinPart) return false;
  const Offsets offsets = offsets_of(points, *line);
  const Step step = largest_step(offsets);
  if (std::abs(step.height_px) < kMinStep_px) return false;
  // The scatter and its correlation are those of the points with the step undone.
  std::vector<EdgePoint> level = points;
  for (std::size_t i = step.at; i < level.size(); ++i) level[i].place_px -= step.height_px * offsets.across;
  const auto fit = fit_line(level);
  if (!fit) return false;
  const double variance = fit->rms_px * fit->rms_px * std::max(1.0, fit->variance_inflation) / step.information;
  if (step.height_px * step.height_px < kStepSigmas * kStepSigmas * variance) return false;
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(step.at);
  if (2 * step.at < points.size()) {
    points.erase(points.begin(), middle);
  } else {
    points.erase(middle, points.end());
  }
  return true;
}

}  // namespace pharos::pointing
