// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/pointing/plane_region.hpp"

namespace pharos::pointing {
namespace {

// Of the panel's length: what a third edge needs to be told from an accident.
constexpr double kMinThirdEdge = 0.15;
constexpr double kThirdEdgeReach_px = 4.0;
constexpr double kThirdEdgeOff = 0.02;  // of the panel's length: what lens and fit leave of one line
constexpr double kMaxSlackOfWidth = 0.5;
constexpr double kOneLine_px = 1.0;  // what a wing's hinges and lens leave of one line, measured
// Pieces of one edge that are nearer were joined; a body between a wing's panels is wider.
constexpr double kMinGap_px = 10.0;
constexpr double kMinStep_px = 2.0;  // accuracy of a segment's ends
// From an outline's line, where blur leaves target on one side and sky on the other; sigmas of the sky between them.
constexpr double kBesideLine_px = 5.0;
constexpr double kSkySigmas = 5.0;
constexpr double kMaxTurnOfSide = 0.1;   // rad, of the rest of a side: LSD's short segments
constexpr double kNearCorner_px = 15.0;  // from a side's end, where an end was followed to short of their corner
constexpr double kMinOfGap = 0.7;        // what stands out of a body hides the rest
// Of a side's length, the other one's: a panel's are alike, a body may hide a part of one.
constexpr double kMinSidesAlike = 0.3;
// Of the target's pixels that a lone panel of a hardly known axis must cover: booms cover 3 to 9 % of them.
constexpr double kMinFractionOfTarget = 0.2;

double line_slack_px(const Segment& own) { return kThirdEdgeReach_px + kThirdEdgeOff * own.length(); }

bool is_beside(const Segment& edge, const Segment& own) {
  const double at = own.station(edge.middle());
  return at >= 0.0 && at <= own.length();
}

// In line with an edge and beyond its end.
bool is_beyond(const Segment& edge, const Segment& own) {
  return !is_beside(edge, own) && std::abs(own.offset(edge.middle())) < line_slack_px(own);
}

// Of an edge beyond another one's end: its own end that is nearer, and how far that is from it along the line.
const Vector2& near_end(const Segment& edge, const Segment& own) {
  return own.station(edge.middle()) > own.length() ? edge.begin : edge.end;
}
double gap_px(const Segment& edge, const Segment& own) {
  const double at = own.station(near_end(edge, own));
  return own.station(edge.middle()) > own.length() ? at - own.length() : -at;
}

bool has_end_at(const PanelHypothesis& h, const Vector2& corner) {
  const std::vector<Segment>& ends = h.measurement.short_edges;
  return std::any_of(ends.begin(), ends.end(), [&](const Segment& end) {
    return std::min((end.begin - corner).norm(), (end.end - corner).norm()) < kNearCorner_px;
  });
}

// Whether the rest of the shorter of two sides may be hidden. Beside a panel's side a short edge of anything else is a
// pair as well, and what confirms that side says nothing about it.
bool are_alike(const Segment& one, const Segment& other) {
  const double first = one.length(), second = other.length();
  return std::min(first, second) > kMinSidesAlike * std::max(first, second);
}

bool has_alike_sides(const PanelHypothesis& h) {
  // A lone panel's long sides in space may be the short ones in the image.
  if (!h.is_wing()) return are_alike(h.sides[0], h.sides[1]);
  return std::all_of(h.pairs.begin(), h.pairs.end(),
                     [](const EdgePair& pair) { return are_alike(pair.first, pair.second); });
}

}  // namespace

bool PanelEvidence::is_confirmed(const PanelHypothesis& h) const {
  if (!has_alike_sides(h) || is_of_yokes(h)) return false;
  if (h.axis.sigma_rad() > kUnsureSigma_rad) return h.is_wing() || is_much_of_target(h);
  if (is_interrupted(h)) return false;
  // The outline of something else, but for two ends that are whole.
  const bool is_rectangle = corners_close(h) && has_square_ends(h) && !h.has_corner_end;
  if (h.has_slanted_end) return h.whole_ends >= 2 && is_rectangle;
  return is_in_line(h) || is_rectangle || (corners_close(h) && is_end_of_plane(h));
}

// A boom is a pair of edges as well, so narrow that perspective tells nothing of its axis.
bool PanelEvidence::is_much_of_target(const PanelHypothesis& h) const {
  const auto pixels = std::count(target_.mask.begin(), target_.mask.end(), std::uint8_t{1});
  const EdgePair& pair = h.pairs.front();
  return pair.middle.length() * pair.separation > kMinFractionOfTarget * static_cast<double>(pixels);
}

// A plane region with one end. That end tests nothing by itself: a direction square to the axis lies in any plane.
bool PanelEvidence::is_end_of_plane(const PanelHypothesis& h) const {
  if (h.has_unknown_end || !h.has_outer_end) return false;
  const EdgePair& pair = h.pairs.front();
  const auto goes_on = [&](const Segment& edge) {
    return std::any_of(h.sides.begin(), h.sides.end(), [&](const Segment& own) {
      return edge.length() > kMinThirdEdge * own.length() && continues_face(h, own, edge);
    });
  };
  return is_one_plane(image_, target_, pair) && std::none_of(outline_.begin(), outline_.end(), goes_on);
}

// Whether an edge is the rest of a side before something that stands out behind it: between them is the same face, with
// no end of it.
bool PanelEvidence::continues_face(const PanelHypothesis& h, const Segment& own, const Segment& edge) const {
  if (!is_beyond(edge, own) || gap_px(edge, own) < kMinGap_px) return false;
  if (edge.along().dot(own.along()) < std::cos(kMaxTurnOfSide)) return false;
  const bool is_after = own.station(edge.middle()) > own.length();
  // A side at whose end the panel's own end begins has its end there.
  if (has_end_at(h, is_after ? own.end : own.begin)) return false;
  const Segment gap = is_after ? Segment{own.end, edge.begin} : Segment{edge.end, own.begin};
  return goes_on_along(image_, target_, h.pairs.front(), own, gap);
}

// What holds a wing's panels is in line as they are, and a strip; its dark limb is no edge, so that its axis is not
// that of the wing.
bool PanelEvidence::is_of_yokes(const PanelHypothesis& h) const {
  if (!h.is_wing()) return false;
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const EdgePair& pair) {
    return is_yoke(h.pairs[0], h.pairs[1], pair) || is_yoke(h.pairs[1], h.pairs[0], pair);
  });
}

bool PanelEvidence::is_in_line(const PanelHypothesis& h) const {
  return h.is_wing() ||
         std::any_of(outline_.begin(), outline_.end(), [&](const Segment& edge) { return is_third(h, edge); });
}

// A side goes on without a gap or a step, at an angle that kept it from being joined: something stands out of one
// outline there, as a panel does on its body. Between a wing's panels is a gap, or their body's edge, with steps.
bool PanelEvidence::is_interrupted(const PanelHypothesis& h) const {
  if (h.is_wing()) {
    const EdgePair &one = h.pairs[0], &other = h.pairs[1];
    const bool same_way = one.first.along().dot(other.first.along()) > 0.0;
    const auto is_one_side = [&](const Segment& own, const Segment& next) {
      return goes_on_between(own, next) || continues_face(h, own, next);
    };
    return is_one_side(one.first, same_way ? other.first : other.second) ||
           is_one_side(one.second, same_way ? other.second : other.first);
  }
  const auto goes_on = [&](const Segment& own, const Segment& edge) {
    if (edge.length() < kMinThirdEdge * own.length() || !is_beyond(edge, own)) return false;
    return gap_px(edge, own) < kMinGap_px && std::abs(own.offset(near_end(edge, own))) < kMinStep_px;
  };
  return std::any_of(outline_.begin(), outline_.end(),
                     [&](const Segment& edge) { return goes_on(h.sides[0], edge) || goes_on(h.sides[1], edge); });
}

// Whether the outline follows the line between two edges: target on one side of it, sky on the other. Foil may be too
// dark there for an edge, and a boom may stand out of it.
bool PanelEvidence::goes_on_between(const Segment& one, const Segment& other) const {
  const bool is_first = one.station(other.middle()) > 0.5 * one.length();
  const Vector2 from = is_first ? one.end : other.end, to = is_first ? other.begin : one.begin;
  const Segment gap{from, to};
  if (gap.length() < kBesideLine_px || gap.along().dot(one.along()) < 0.0) return false;
  const double limit = target_.sky + kSkySigmas * target_.noise;
  const auto is_lit = [&](const Vector2& place) {
    const auto u = std::clamp(static_cast<std::int32_t>(std::lround(place.x())), 0, image_.width_px - 1);
    const auto v = std::clamp(static_cast<std::int32_t>(std::lround(place.y())), 0, image_.height_px - 1);
    return image_.at(u, v) > limit;
  };
  int places = 0, on_outline = 0;
  for (double at = 0.0; at <= gap.length(); at += 1.0, ++places) {
    const Vector2 place = gap.begin + at * gap.along();
    if (is_lit(place + kBesideLine_px * gap.across()) && !is_lit(place - kBesideLine_px * gap.across())) ++on_outline;
  }
  return on_outline >= kMinOfGap * places;
}

// An edge in line with one of the panel's own that runs along its axis: the other panel's, where that is half hidden.
bool PanelEvidence::is_third(const PanelHypothesis& h, const Segment& edge) const {
  const EdgePair& pair = h.pairs.front();
  if (edge.length() < kMinThirdEdge * pair.middle.length()) return false;
  const auto is_own = [&](const Segment& own) { return edge.begin == own.begin && edge.end == own.end; };
  if (is_own(pair.first) || is_own(pair.second)) return false;
  // As near to a narrow pair's other side, or to anything that hides its end, it is in line by accident: a boom's.
  if (line_slack_px(pair.middle) > kMaxSlackOfWidth * pair.separation) return false;
  if (is_of_a_narrower(pair, edge)) return false;
  // In line with one of them and beyond its end, with a gap: beside it a body's edges are as parallel. Where it is
  // beside the other one, or the outline goes on to it, it is the rest of the same side.
  const auto is_thirds_side = [&](const Segment& own, const Segment& opposite) {
    return is_beyond(edge, own) && gap_px(edge, own) > kMinGap_px && !is_beside(edge, opposite) &&
           !goes_on_between(own, edge) && !continues_face(h, own, edge);
  };
  if (!is_thirds_side(pair.first, pair.second) && !is_thirds_side(pair.second, pair.first)) return false;
  const auto side = measured_side(image_, target_, camera_, edge, kThirdEdgeReach_px);
  if (!side || side->fit.length_px() < kMinThirdEdge * pair.middle.length()) return false;
  if (!is_in_line_with_a_side(h, side->fit)) return false;
  const AxisPlane plane = plane_of_line(side->fit.line, camera_);
  // An edge whose own direction is open would lie along anything.
  return plane.sigma_rad(h.axis.axis) < kMaxSquareSigma_rad && lies_along(plane, h.axis);
}

// Whether an edge faces another one that is too near for a wing's other panel: something else, or hardly any of it
// seen.
bool PanelEvidence::is_of_a_narrower(const EdgePair& own, const Segment& edge) const {
  const auto is_it = [&](const Segment& other) { return edge.begin == other.begin && edge.end == other.end; };
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const EdgePair& pair) {
    return (is_it(pair.first) || is_it(pair.second)) && kWingWidths * pair.separation < own.separation;
  });
}

// The outline's slack holds what is in line by accident; a wing's edges are one straight line, once measured.
bool PanelEvidence::is_in_line_with_a_side(const PanelHypothesis& h, const LineFit& edge) const {
  const Vector3 ray = ray_of(0.5 * (edge.begin_px + edge.end_px), camera_).normalized();
  return std::any_of(h.measurement.long_planes.begin(), h.measurement.long_planes.end(), [&](const AxisPlane& own) {
    const double slack_rad = kOneLine_px / camera_.fx_px;
    return std::abs(own.normal.dot(ray)) < kMaxSigmas * own.sigma_rad(ray) + slack_rad;
  });
}

}  // namespace pharos::pointing
