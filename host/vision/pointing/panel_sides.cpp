// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_sides.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/vision/pointing/edge_pieces.hpp"
#include "host/vision/pointing/edge_points.hpp"

namespace pharos::pointing {
namespace {

constexpr double kReachFraction = 0.45;   // of the distance to the opposite edge
constexpr double kMinSeenFraction = 0.4;  // of a short edge's length
// Corners, where long edges end: where they were followed to, past a rounded corner or short of a frame.
constexpr double kCornerOff_px = 6.0;
constexpr double kCornerOffFraction = 0.015;
constexpr double kMaxEndTurn = 0.1;
// Of an edge's contrast: what optics scatter beside an edge stays below it.
constexpr double kMaxBacking = 0.015;
// And behind both sides it is the same. Of 949 panels of 550 random satellites two are apart by more (0.99 and 1.25 %
// of the contrast: a body stands behind one side), 99.5 of a hundred by less than 0.1 %.
constexpr double kMaxBackdropsApart = 0.004;
constexpr double kBackdropSigmas = 5.0;
// Of 228 panels of 120 random satellites two of a hundred have sides that differ by more: frame on one, cells on the
// other. Faces that the sun lights differently differ by three times.
constexpr double kMaxBrighter = 2.0;

// The outline's edge between two corners that are known to some pixels; the longest, where others interrupt it.
const Segment* edge_along(const Segment& guess, const std::vector<Segment>& outline) {
  const double slack = kCornerOff_px + kCornerOffFraction * guess.length();
  const Segment* best = nullptr;
  for (const Segment& edge : outline) {
    if (edge.along().dot(guess.along()) < std::cos(kMaxEndTurn)) continue;
    if (std::abs(guess.offset(edge.begin)) > slack || std::abs(guess.offset(edge.end)) > slack) continue;
    if (guess.station(edge.end) < 0.0 || guess.station(edge.begin) > guess.length()) continue;
    if (best == nullptr || edge.length() > best->length()) best = &edge;
  }
  return best;
}

// The ends of a panel: from the end of each long side to the beginning of the other.
void measure_ends(ImageView<const std::uint16_t> image, const TargetMask& target, const PinholeCamera& camera,
                  const std::vector<Segment>& outline, PanelSides& panel) {
  for (const auto& [from, to] : {std::pair{panel.first.extent.end, panel.second.extent.begin},
                                 {panel.second.extent.end, panel.first.extent.begin}}) {
    const Segment guess{from, to};
    const double reach = kReachFraction * std::min(panel.first.extent.length(), panel.second.extent.length());
    if (guess.length() < 4.0) continue;
    const Segment* seen = edge_along(guess, outline);
    const auto side = measured_side(image, target, camera, seen != nullptr ? *seen : guess, reach);
    if (!side || side->cut || side->fit.length_px() < kMinSeenFraction * guess.length()) continue;
    panel.ends.push_back(*side);
  }
}

}  // namespace

Result<Side, PointingRefusal> measured_side(ImageView<const std::uint16_t> image, const TargetMask& target,
                                            const PinholeCamera& camera, const Segment& guess, double reach_px) {
  MeasuredEdge edge = measure_edge(image, target, guess, reach_px);
  Side side;
  side.cut = edge.cut;
  side.blur_px = edge.blur_px;
  side.contrast = edge.contrast;
  side.backing = edge.backing;
  side.backdrop = edge.backdrop;
  side.structure_px = edge.structure_px;
  side.extent = edge.extent;
  side.points = std::move(edge.points);
  if (keep_one_edge(side.points, side.structure_px, edge.corner_px) && !side.points.empty()) {
    side.extent = {side.points.front().place_px, side.points.back().place_px};
  }
  if (!pointing::undo_distortion(side.points, camera)) return PointingRefusal::kOutsideLens;
  const auto fit = pointing::fit_line(side.points);
  if (!fit) return side.cut ? PointingRefusal::kCutByBorder : PointingRefusal::kEdgeUnsure;
  side.fit = *fit;
  return side;
}

bool are_apart(const Side& one, const Side& other) {
  if (!one.backdrop || !other.backdrop) return false;
  const double sigma = std::hypot(one.backdrop->sigma, other.backdrop->sigma);
  const double limit = kMaxBackdropsApart * std::min(one.contrast, other.contrast) + kBackdropSigmas * sigma;
  return std::abs(one.backdrop->level - other.backdrop->level) > limit;
}

// A panel is thin: beyond its sides is sky. Beyond a face's is another face, in the dark. And it is one plane: where
// one of two sides is far brighter than the other, they are of two faces.
bool is_of_faces(const PanelSides& panel) {
  const auto [dark, bright] = std::minmax(panel.first.contrast, panel.second.contrast);
  return std::max(panel.first.backing, panel.second.backing) > kMaxBacking || are_apart(panel.first, panel.second) ||
         bright > kMaxBrighter * dark;
}

Result<PanelSides, PointingRefusal> measured_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                                   const PinholeCamera& camera, const EdgePair& pair,
                                                   const std::vector<Segment>& outline) {
  const double reach = kReachFraction * pair.separation;
  const auto first = measured_side(image, target, camera, pair.first, reach);
  const auto second = measured_side(image, target, camera, pair.second, reach);
  for (const auto* side : {&first, &second}) {
    if (*side ? (*side)->cut : side->error() == PointingRefusal::kCutByBorder) return PointingRefusal::kCutByBorder;
  }
  if (first.ok() != second.ok()) {
    const PointingRefusal why = first ? second.error() : first.error();
    return why == PointingRefusal::kEdgeUnsure ? PointingRefusal::kOneEdge : why;
  }
  if (!first) return first.error();
  PanelSides panel{*first, *second, {}};
  measure_ends(image, target, camera, outline, panel);
  return panel;
}

}  // namespace pharos::pointing
