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

}  // namespace pharos::pointing
