// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_hypothesis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/vision/pointing/panel_measurement.hpp"
#include "host/vision/pointing/plane_region.hpp"
#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

constexpr double kMinAspect = 1.3;  // of a lone panel; a body is as long as wide
// Pairs that are measured, the longest: a wing's four edges make four, a body's as many.
constexpr std::size_t kMaxPairs = 12;
constexpr double kWingBonus = 1.6;  // a second panel in line is no accident
// Beyond chance, and what lens and blur move edges by.
constexpr double kMaxSigmas = 5.0;
constexpr double kAngleSlack_rad = 0.3 * kRadPerDeg;
// A test of right angles that could not have failed confirms nothing.
constexpr double kMaxSquareSigma_rad = 3.0 * kRadPerDeg;
// Of the panel's length: what a third edge needs to be told from an accident.
constexpr double kMinThirdEdge = 0.15;
constexpr double kThirdEdgeReach_px = 4.0;
constexpr double kThirdEdgeOff = 0.02;  // of the panel's length: what lens and fit leave of one line
constexpr double kMaxSlackOfWidth = 0.5;
constexpr double kOneLine_px = 1.0;  // what a wing's hinges and lens leave of one line, measured
// Pieces of one edge that are nearer were joined; a body between a wing's panels is wider.
constexpr double kMinGap_px = 10.0;
constexpr double kMinStep_px = 2.0;  // accuracy of a segment's ends
// Nearer to the line of sight an axis is a matter of the panel's thickness.
constexpr double kMinFromSight_rad = 10.0 * kRadPerDeg;
// Of the best one's length: a shorter one is no rival.
constexpr double kRivalLength = 0.5;
constexpr double kOtherAxis_rad = 1.0 * kRadPerDeg;
// What blur, a frame or a rounded corner leave between the two corners of a panel's end.
constexpr double kCornerOff_px = 10.0;
constexpr double kCornerOffFraction = 0.01;  // of the side's length
// In the image, between the middle lines of a wing's panels: perspective draws them together in one line.
constexpr double kMaxTurnOfWing_rad = 0.15;

struct Hypothesis {
  std::vector<EdgePair> pairs;
  PanelMeasurement measurement;
  AxisEstimate axis;  // in C
  double score = 0.0;
  bool is_of_faces = false;        // no panel's, if its sides are measured right: it competes and is no answer
  std::array<Segment, 2> sides{};  // of a lone pair: the long ones, in the image
};

double angle_of(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

// How far an edge's plane is off an axis, and that angle's sigma.
bool lies_along(const AxisPlane& plane, const AxisEstimate& axis) {
  const double off = std::abs(std::asin(std::clamp(plane.normal.dot(axis.axis), -1.0, 1.0)));
  const double sigma =
      std::hypot(plane.sigma_rad(axis.axis), std::sqrt(plane.normal.dot(axis.covariance * plane.normal)));
  return off < kMaxSigmas * sigma + kAngleSlack_rad;
}

bool lies_in(const AxisPlanes& planes, const AxisEstimate& axis) {
  return std::all_of(planes.begin(), planes.end(), [&](const AxisPlane& plane) { return lies_along(plane, axis); });
}

// Angle between long sides and ends beyond a right one, where both ends are seen.
struct Square {
  double off_rad = 0.0;
  double sigma_rad = 0.0;
};
std::optional<Square> square_of(const PanelMeasurement& panel, const AxisEstimate& axis) {
  if (panel.short_planes.size() < 2) return std::nullopt;
  const auto across = estimate_axis({panel.short_planes.data(), panel.short_planes.size()});
  if (!across) return std::nullopt;
  const double variance =
      across->axis.dot(axis.covariance * across->axis) + axis.axis.dot(across->covariance * axis.axis);
  return Square{0.5 * kPi - angle_of(axis.axis, across->axis), std::sqrt(variance)};
}

// How far beyond a side the line of an end of the panel crosses the side's line.
double beyond_side_px(const Segment& side, const Segment& end) {
  const double from = end.offset(side.begin), to = end.offset(side.end);
  if (std::abs(from - to) < 1e-9) return 0.0;
  const double station = from / (from - to) * side.length();
  return std::max({0.0, -station, station - side.length()});
}

// Whether every end meets both sides alike. A body's outline is cut at a corner by an edge of a third direction: its
// opposite sides are of two faces, and the ends of one of them.
bool corners_close(const PanelMeasurement& panel) {
  const Segment& first = panel.long_edges.front();
  const Segment& last = panel.long_edges.back();
  const double slack_px = kCornerOff_px + kCornerOffFraction * std::max(first.length(), last.length());
  return std::all_of(panel.short_edges.begin(), panel.short_edges.end(), [&](const Segment& end) {
    return std::abs(beyond_side_px(first, end) - beyond_side_px(last, end)) < slack_px;
  });
}

bool is_contradicted(const Hypothesis& h) {
  const auto square = square_of(h.measurement, h.axis);
  if (square && square->off_rad > kMaxSigmas * square->sigma_rad + kAngleSlack_rad) return true;
  // The sides of a wing's two panels are parallel in space.
  return !lies_in(h.measurement.long_planes, h.axis);
}

std::optional<AxisEstimate> axis_of(const PanelMeasurement& panel) {
  const auto axis = estimate_axis({panel.long_planes.data(), panel.long_planes.size()});
  return axis ? std::optional(*axis) : std::nullopt;
}

// Long and short side by their lengths in space; false where it is no panel, or where it is not known which is longer.
bool settle_sides(const EdgePair& pair, const PanelSides& measured, const PinholeCamera& camera, Hypothesis& lone) {
  PanelMeasurement& panel = lone.measurement;
  lone.sides = {pair.first, pair.second};
  const auto in_space = aspect_in_space(panel, camera);
  if (!in_space) return pair.middle.length() >= kMinAspect * pair.separation;
  if (in_space->minimum >= kMinAspect) return true;
  if (in_space->maximum * kMinAspect > 1.0 || panel.short_planes.size() < 2) return false;
  std::swap(panel.long_planes, panel.short_planes);
  std::swap(panel.long_edges, panel.short_edges);
  lone.sides = {measured.ends[0].extent, measured.ends[1].extent};
  // Known by the other axis, of which the sigma may be another.
  const auto swapped = aspect_in_space(panel, camera);
  return !swapped || swapped->minimum >= kMinAspect;
}

// A panel that runs across the body leaves two pieces of its width on either side, as a wing's panels do. Its ends are
// then the long sides. False where the wing is not longer than wide.
bool settle_wing(Hypothesis& wing, const PinholeCamera& camera) {
  const auto in_space = aspect_in_space(wing.measurement, camera);
  if (!in_space || in_space->minimum >= kMinAspect) return true;
  if (in_space->maximum * kMinAspect > 1.0 || wing.measurement.short_planes.size() < 2) return false;
  std::swap(wing.measurement.long_planes, wing.measurement.short_planes);
  std::swap(wing.measurement.long_edges, wing.measurement.short_edges);
  const auto axis = axis_of(wing.measurement);
  if (!axis) return false;
  wing.axis = *axis;
  return true;
}

class Chooser {
 public:
  Chooser(ImageView<const std::uint16_t> image, const TargetMask& target, const PinholeCamera& camera,
          const std::vector<Segment>& outline)
      : image_(image), target_(target), camera_(camera), outline_(outline) {}

  void measure(std::vector<EdgePair> pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const EdgePair& a, const EdgePair& b) { return a.middle.length() > b.middle.length(); });
    if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
    for (const EdgePair& pair : pairs) {
      const auto panel = measured_panel(image_, target_, camera_, pair, outline_);
      if (panel) {
        measured_.push_back({pair, *panel});
      } else if (!refusal_ || panel.error() == PointingRefusal::kCutByBorder) {
        refusal_ = panel.error();
      }
      if (!panel) (panel.error() == PointingRefusal::kCutByBorder ? cut_ : unsure_).push_back(pair);
    }
  }

  Result<PanelMeasurement, PointingRefusal> choice() {
    if (measured_.empty()) return *refusal_;
    std::vector<Hypothesis> hypotheses = wings();
    for (const auto& [pair, sides] : measured_) add_lone(pair, sides, hypotheses);
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
    std::erase_if(hypotheses, [](const Hypothesis& h) { return is_contradicted(h); });
    const auto confirmed = std::find_if(hypotheses.begin(), hypotheses.end(),
                                        [&](const Hypothesis& h) { return !h.is_of_faces && is_confirmed(h); });
    if (confirmed == hypotheses.end()) return cut_.empty() ? PointingRefusal::kNoPanel : PointingRefusal::kCutByBorder;
    Hypothesis& best = *confirmed;
    if (is_along_sight(best)) return PointingRefusal::kAlongSight;
    if (has_rival_of(cut_, kRivalLength, best)) return PointingRefusal::kCutByBorder;
    if (has_rival_of(unsure_, 1.0, best)) return PointingRefusal::kEdgeUnsure;
    const bool in_line = is_in_line(best);
    for (const Hypothesis& other : hypotheses) {
      if (!is_rival(best, other)) continue;
      // A body's outline is a rectangle as well, and a third edge may be an accident: alone they do not outweigh
      // another pair that nothing confirms, nor a longer one.
      const bool needs_proof = best.pairs.size() == 2 || (in_line && other.score < best.score);
      if (needs_proof && (other.is_of_faces || !is_confirmed(other))) continue;
      best.measurement.other_planes = other.measurement.long_planes;
      break;
    }
    if (!cut_.empty() && best.pairs.size() == 1) best.measurement.flags |= kFlagPanelCut;
    return best.measurement;
  }

 private:
  std::vector<Hypothesis> wings() const {
    std::vector<Hypothesis> wings;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      for (std::size_t k = i + 1; k < measured_.size(); ++k) {
        const auto& [a, a_sides] = measured_[i];
        const auto& [b, b_sides] = measured_[k];
        if (is_of_faces(a_sides) || is_of_faces(b_sides) || !is_wing(a, b)) continue;
        Hypothesis wing{{a, b}, measurement_of({a_sides, b_sides}, camera_), {}, 0.0};
        const auto axis = axis_of(wing.measurement);
        if (!axis) continue;
        wing.axis = *axis;
        if (!settle_wing(wing, camera_)) continue;
        wing.score = kWingBonus * (a.middle.length() + b.middle.length());
        wings.push_back(std::move(wing));
      }
    }
    return wings;
  }

  void add_lone(const EdgePair& pair, const PanelSides& sides, std::vector<Hypothesis>& hypotheses) const {
    Hypothesis lone{{pair}, measurement_of({sides}, camera_), {}, pair.middle.length()};
    if (!settle_sides(pair, sides, camera_, lone)) return;
    const auto axis = axis_of(lone.measurement);
    if (!axis) return;
    lone.axis = *axis;
    lone.is_of_faces = is_of_faces(sides);
    hypotheses.push_back(std::move(lone));
  }

  bool is_confirmed(const Hypothesis& h) const {
    if (h.axis.sigma_rad() > kUnsureSigma_rad) return true;
    if (is_interrupted(h)) return false;
    return is_in_line(h) || (corners_close(h.measurement) && (is_square(h) || is_end_of_plane(h)));
  }

  static bool is_square(const Hypothesis& h) {
    const auto square = square_of(h.measurement, h.axis);
    return square && square->sigma_rad < kMaxSquareSigma_rad;
  }

  // A plane region with one end. That end tests nothing by itself: a direction square to the axis lies in any plane.
  bool is_end_of_plane(const Hypothesis& h) const {
    return !h.measurement.short_planes.empty() && is_one_plane(image_, target_, h.pairs.front());
  }

  // Two panels on one axis, or one and an edge of another.
  bool is_in_line(const Hypothesis& h) const {
    return h.pairs.size() == 2 ||
           std::any_of(outline_.begin(), outline_.end(), [&](const Segment& edge) { return is_third(h, edge); });
  }

  // A side goes on without a gap or a step, at an angle that kept it from being joined: something stands out of one
  // outline there, as a panel does on its body. Between a wing's panels is a gap, or their body's edge, with steps.
  bool is_interrupted(const Hypothesis& h) const {
    if (h.pairs.size() == 2) return false;
    const auto goes_on = [&](const Segment& own, const Segment& edge) {
      if (edge.length() < kMinThirdEdge * own.length() || !is_beyond(edge, own)) return false;
      const bool after = own.station(edge.middle()) > own.length();
      const Vector2& near = after ? edge.begin : edge.end;
      return (after ? own.station(near) - own.length() : -own.station(near)) < kMinGap_px &&
             std::abs(own.offset(near)) < kMinStep_px;
    };
    return std::any_of(outline_.begin(), outline_.end(),
                       [&](const Segment& edge) { return goes_on(h.sides[0], edge) || goes_on(h.sides[1], edge); });
  }

  // In line with an edge and beyond its end.
  static bool is_beyond(const Segment& edge, const Segment& own) {
    const double at = own.station(edge.middle());
    return (at < 0.0 || at > own.length()) && std::abs(own.offset(edge.middle())) < line_slack_px(own);
  }

  static double line_slack_px(const Segment& own) { return kThirdEdgeReach_px + kThirdEdgeOff * own.length(); }

  // An edge in line with one of the panel's own that runs along its axis: the other panel's, where that is half hidden.
  bool is_third(const Hypothesis& h, const Segment& edge) const {
    const EdgePair& pair = h.pairs.front();
    if (edge.length() < kMinThirdEdge * pair.middle.length()) return false;
    const auto is_own = [&](const Segment& own) { return edge.begin == own.begin && edge.end == own.end; };
    if (is_own(pair.first) || is_own(pair.second)) return false;
    // As near to a narrow pair's other side, or to anything that hides its end, it is in line by accident: a boom's.
    if (line_slack_px(pair.middle) > kMaxSlackOfWidth * pair.separation) return false;
    // In line with one of them and beyond its end: beside it a body's edges are as parallel.
    if (!is_beyond(edge, pair.first) && !is_beyond(edge, pair.second)) return false;
    const auto side = measured_side(image_, target_, camera_, edge, kThirdEdgeReach_px);
    if (!side || side->fit.length_px() < kMinThirdEdge * pair.middle.length()) return false;
    if (!is_in_line_with_a_side(h, side->fit)) return false;
    const AxisPlane plane = plane_of_line(side->fit.line, camera_);
    // An edge whose own direction is open would lie along anything.
    return plane.sigma_rad(h.axis.axis) < kMaxSquareSigma_rad && lies_along(plane, h.axis);
  }

  // The outline's slack holds what is in line by accident; a wing's edges are one straight line, once measured.
  bool is_in_line_with_a_side(const Hypothesis& h, const LineFit& edge) const {
    const Vector3 ray = ray_of(0.5 * (edge.begin_px + edge.end_px)).normalized();
    return std::any_of(h.measurement.long_planes.begin(), h.measurement.long_planes.end(), [&](const AxisPlane& own) {
      const double slack_rad = kOneLine_px / camera_.fx_px;
      return std::abs(own.normal.dot(ray)) < kMaxSigmas * own.sigma_rad(ray) + slack_rad;
    });
  }

  // In the ideal image.
  Vector3 ray_of(const Vector2& place) const {
    return {(place.x() - camera_.cx_px) / camera_.fx_px, (place.y() - camera_.cy_px) / camera_.fy_px, 1.0};
  }

  // A pair that the border cuts, or of which a side is no straight line, has no axis. Where it does not continue the
  // lone best one as a wing's other panel, it may be the panel instead.
  static bool has_rival_of(const std::vector<EdgePair>& pairs, double min_length, const Hypothesis& best) {
    // Its long sides in space may be the short ones in the image.
    return best.pairs.size() == 1 && std::any_of(pairs.begin(), pairs.end(), [&](const EdgePair& pair) {
             return pair.middle.length() > min_length * best.score &&
                    std::abs(pair.middle.along().dot(best.sides[0].along())) < std::cos(kMaxTurnOfWing_rad);
           });
  }

  bool is_along_sight(const Hypothesis& h) const {
    if (h.axis.sigma_rad() > kUnsureSigma_rad) return false;
    return angle_of(ray_of(h.pairs.front().middle.middle()), h.axis.axis) < kMinFromSight_rad;
  }

  static double longest_panel_px(const Hypothesis& h) {
    double longest = 0.0;
    for (const EdgePair& pair : h.pairs) longest = std::max(longest, pair.middle.length());
    return longest;
  }

  static bool is_rival(const Hypothesis& best, const Hypothesis& other) {
    // Pieces of a body's two sides beside its wings are in line as a wing's panels are, and shorter than a panel of it.
    const double min_length =
        other.pairs.size() < best.pairs.size() ? longest_panel_px(best) : kRivalLength * best.score;
    if (other.score < min_length) return false;
    // An axis that is hardly known agrees with any other in the plane of its edges, which is known.
    if (other.axis.sigma_rad() > kUnsureSigma_rad) return !lies_in(other.measurement.long_planes, best.axis);
    const double sigma = std::hypot(best.axis.sigma_rad(), other.axis.sigma_rad());
    return angle_of(best.axis.axis, other.axis.axis) > std::max(kOtherAxis_rad, kMaxSigmas * sigma);
  }

  ImageView<const std::uint16_t> image_;
  const TargetMask& target_;
  const PinholeCamera& camera_;
  const std::vector<Segment>& outline_;
  std::vector<std::pair<EdgePair, PanelSides>> measured_;
  std::optional<PointingRefusal> refusal_;
  std::vector<EdgePair> cut_;     // by the image's border
  std::vector<EdgePair> unsure_;  // not both sides are measured
};

}  // namespace

Result<PanelMeasurement, PointingRefusal> choose_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                                       const PinholeCamera& camera, const std::vector<Segment>& outline,
                                                       const std::vector<EdgePair>& pairs) {
  Chooser chooser(image, target, camera, outline);
  chooser.measure(pairs);
  return chooser.choice();
}

}  // namespace pharos::pointing
