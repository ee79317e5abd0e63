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
// From where an edge of the outline that begins at a side's end is no more of that side; and what is measured of it.
constexpr double kMinCornerTurn = 0.2;
constexpr double kMinCornerEdge = 0.1;  // of the distance between the sides
constexpr double kMinCornerEdge_px = 12.0;
constexpr double kMaxUnmeasured = 0.15;  // of a side, beside a sharp corner
// Of an edge's contrast: what optics scatter beside an edge stays below it.
constexpr double kMaxBacking = 0.015;
// And behind both sides it is the same. Of 949 panels of 550 random satellites two are apart by more (0.99 and 1.25 %
// of the contrast: a body stands behind one side), 99.5 of a hundred by less than 0.1 %.
constexpr double kMaxBackdropsApart = 0.004;
constexpr double kBackdropSigmas = 5.0;
// Of 228 panels of 120 random satellites two of a hundred have sides that differ by more: frame on one, cells on the
// other. Faces that the sun lights differently differ by three times.
constexpr double kMaxBrighter = 2.0;

// Whether an edge is a piece of what is expected between two corners that are known to some pixels.
bool lies_on(const Segment& edge, const Segment& guess) {
  const double slack = kCornerOff_px + kCornerOffFraction * guess.length();
  return std::abs(guess.offset(edge.begin)) < slack && std::abs(guess.offset(edge.end)) < slack;
}

// The outline's edge between two corners that are known to some pixels; the longest, where others interrupt it.
const Segment* edge_along(const Segment& guess, const std::vector<Segment>& outline) {
  const Segment* best = nullptr;
  for (const Segment& edge : outline) {
    if (edge.along().dot(guess.along()) < std::cos(kMaxEndTurn) || !lies_on(edge, guess)) continue;
    if (guess.station(edge.end) < 0.0 || guess.station(edge.begin) > guess.length()) continue;
    if (best == nullptr || edge.length() > best->length()) best = &edge;
  }
  return best;
}

bool are_apart(const Side& one, const Side& other) {
  if (!one.backdrop || !other.backdrop) return false;
  const double sigma = std::hypot(one.backdrop->sigma, other.backdrop->sigma);
  const double limit = kMaxBackdropsApart * std::min(one.contrast, other.contrast) + kBackdropSigmas * sigma;
  return std::abs(one.backdrop->level - other.backdrop->level) > limit;
}

// Whether the outline turns inwards where one edge ends and the next one begins: a corner of one thing. What hides a
// side's end turns it outwards.
bool is_corner(const Segment& edge, const Segment& next) {
  const double turn = edge.across().dot(next.along());  // its sine
  if (turn < std::sin(kMinCornerTurn)) return false;
  // Where edges meet at a small angle, each may be followed beyond their corner by so much more.
  const double slack = kCornerOff_px + kCornerOffFraction * edge.length();
  return std::abs(edge.offset(next.begin)) < slack && std::abs(edge.station(next.begin) - edge.length()) < slack / turn;
}

struct EndSearch {
  ImageView<const std::uint16_t> image;
  const TargetMask& target;
  const PinholeCamera& camera;
  const std::vector<Segment>& outline;

  // From the end of one long side to the beginning of the other.
  void measure(const Side& side, const Side& other, double reach_px, PanelSides& panel) const {
    const Segment guess{side.extent.end, other.extent.begin};
    if (guess.length() < 4.0) return;
    const Segment* seen = edge_along(guess, outline);
    // Of sides that were measured in pieces the corners are left out: the end is where the outline has them.
    const Segment between{whole(side).end, whole(other).begin};
    if (seen == nullptr) seen = edge_along(between, outline);
    const auto whole_end = measured_side(image, target, camera, seen != nullptr ? *seen : guess, reach_px);
    if (whole_end && !whole_end->cut && whole_end->fit.length_px() >= kMinSeenFraction * guess.length()) {
      panel.ends.push_back(*whole_end);
      return;
    }
    // Something hides the end, or the sides are of two things. Where one of them goes on to a corner, the edge there
    // is the end.
    const double min_length = std::max(kMinCornerEdge_px, kMinCornerEdge * guess.length());
    for (const Segment& edge : outline) {
      if (edge.length() < min_length || !(is_corner(whole(side), edge) || is_corner(edge, whole(other)))) continue;
      const auto end = measured_side(image, target, camera, edge, reach_px);
      const bool is_cut = end ? end->cut : end.error() == PointingRefusal::kCutByBorder;
      panel.has_unknown_end = panel.has_unknown_end || is_cut;
      if (!end || is_cut || end->fit.length_px() < min_length) continue;
      if (is_before_a_face(*end, side)) continue;  // which hides the panel there
      panel.corner_ends.push_back(*end);
    }
  }

  // A side as its outline, where that ends a little beyond: near a sharp corner nothing was measured.
  Segment whole(const Side& side) const {
    Segment whole = side.extent;
    const double reach_px = kMaxUnmeasured * whole.length();
    for (const Segment& edge : outline) {
      if (std::abs(side.extent.offset(edge.middle())) > kCornerOff_px) continue;
      // A short edge that cuts the corner off is near the side's line as well.
      if (edge.along().dot(side.extent.along()) < std::cos(kMaxEndTurn)) continue;
      const auto is_near = [&](const Vector2& a, const Vector2& b) { return (a - b).norm() < reach_px; };
      if (is_near(edge.begin, side.extent.begin) && side.extent.station(edge.begin) < 0.0) whole.begin = edge.begin;
      if (is_near(edge.end, side.extent.end) && side.extent.station(edge.end) > side.extent.length())
        whole.end = edge.end;
    }
    return whole;
  }
};

void measure_ends(const EndSearch& search, PanelSides& panel) {
  const double reach = kReachFraction * std::min(panel.first.extent.length(), panel.second.extent.length());
  search.measure(panel.first, panel.second, reach, panel);
  search.measure(panel.second, panel.first, reach, panel);
}

}  // namespace

Result<Side, PointingRefusal> measured_side(ImageView<const std::uint16_t> image, const TargetMask& target,
                                            const PinholeCamera& camera, const Segment& guess, double reach_px) {
  MeasuredEdge edge = measure_edge(image, target, guess, reach_px);
  Side side;
  side.cut = edge.cut;
  // A line through two edges decided which rises are its own: of one of them, those on the other's side are missing.
  if (keep_one_edge(edge.points, edge.structure_px, edge.corner_px) && !edge.points.empty()) {
    edge = measure_edge(image, target, {edge.points.front().place_px, edge.points.back().place_px}, reach_px);
    side.cut = side.cut || edge.cut;
  }
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
  keep_one_part(side.points);
  const auto fit = pointing::fit_line(side.points);
  if (!fit) return side.cut ? PointingRefusal::kCutByBorder : PointingRefusal::kEdgeUnsure;
  side.fit = *fit;
  return side;
}

bool is_before_a_face(const Side& end, const Side& side) { return end.backing > kMaxBacking || are_apart(end, side); }

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
  PanelSides panel{*first, *second, {}, {}, false};
  measure_ends({image, target, camera, outline}, panel);
  return panel;
}

}  // namespace pharos::pointing
