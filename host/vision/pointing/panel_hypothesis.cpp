// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace pharos::pointing {
namespace {

constexpr double kMinAspect = 1.3;  // of a lone panel; a body is as long as wide
constexpr double kWingBonus = 1.6;  // a second panel in line is no accident
// Beyond chance, what lens and blur move edges by.
constexpr double kAngleSlack_rad = 0.3 * kRadPerDeg;
// What blur, a frame or a rounded corner leave between the two corners of a panel's end.
constexpr double kCornersApart_px = 10.0;
constexpr double kCornersApartFraction = 0.01;  // of the side's length
// What lens and fit leave of one line between two pieces of an end, and of the distance between them.
constexpr double kOneEnd_px = 4.0;
constexpr double kOneEndFraction = 0.02;

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

std::optional<AxisEstimate> axis_of(const PanelMeasurement& panel) {
  const auto axis = estimate_axis({panel.long_planes.data(), panel.long_planes.size()});
  return axis ? std::optional(*axis) : std::nullopt;
}

// Whether ends are of more than one line: two pieces of one end, seen at either corner, are no two sides.
bool are_of_two_lines(const std::vector<Side>& ends) {
  return std::any_of(ends.begin(), ends.end(), [&](const Side& end) {
    const Segment &first = ends.front().extent, &other = end.extent;
    const double slack_px = kOneEnd_px + kOneEndFraction * (other.middle() - first.middle()).norm();
    return std::max(std::abs(first.offset(other.begin)), std::abs(first.offset(other.end))) > slack_px;
  });
}

// Long and short side by their lengths in space; false where it is no panel, or where it is not known which is longer.
bool settle_sides(const EdgePair& pair, const PanelSides& measured, const PinholeCamera& camera,
                  PanelHypothesis& lone) {
  PanelMeasurement& panel = lone.measurement;
  lone.sides = {pair.first, pair.second};
  const auto in_space = aspect_in_space(panel, camera);
  if (!in_space) return pair.middle.length() >= kMinAspect * pair.separation;
  if (in_space->minimum >= kMinAspect) return true;
  if (in_space->maximum * kMinAspect > 1.0 || !are_of_two_lines(measured.ends)) return false;
  std::swap(panel.long_planes, panel.short_planes);
  std::swap(panel.long_planes_moved, panel.short_planes_moved);
  std::swap(panel.long_edges, panel.short_edges);
  lone.sides = {measured.ends.front().extent, measured.ends.back().extent};
  lone.whole_ends = panel.short_edges.size();
  lone.has_outer_end = true;
  lone.is_of_faces = is_of_faces({measured.ends.front(), measured.ends.back(), {}, {}, false});
  // Known by the other axis, of which the sigma may be another.
  const auto swapped = aspect_in_space(panel, camera);
  return !swapped || swapped->minimum >= kMinAspect;
}

// A panel that runs across the body leaves two pieces of its width on either side, as a wing's panels do. Its ends are
// then the long sides. False where the wing is not longer than wide.
bool settle_wing(const std::vector<Side>& ends, const PinholeCamera& camera, PanelHypothesis& wing) {
  const auto in_space = aspect_in_space(wing.measurement, camera);
  if (!in_space || in_space->minimum >= kMinAspect) return true;
  if (in_space->maximum * kMinAspect > 1.0 || !are_of_two_lines(ends)) return false;
  std::swap(wing.measurement.long_planes, wing.measurement.short_planes);
  std::swap(wing.measurement.long_planes_moved, wing.measurement.short_planes_moved);
  std::swap(wing.measurement.long_edges, wing.measurement.short_edges);
  const auto axis = axis_of(wing.measurement);
  if (!axis) return false;
  wing.axis = *axis;
  return true;
}

PanelSides with_corner_ends(PanelSides sides) {
  sides.ends.insert(sides.ends.end(), sides.corner_ends.begin(), sides.corner_ends.end());
  return sides;
}

// `whole_ends`: of the sides' ends, the first.
std::optional<PanelHypothesis> lone_with(const EdgePair& pair, const PanelSides& sides, std::size_t whole_ends,
                                         const PinholeCamera& camera) {
  PanelHypothesis lone{{pair}, measurement_of({sides}, camera), {}, pair.middle.length()};
  lone.whole_ends = whole_ends;
  // Where the body hides a panel's other end, the one that is seen is the outer one.
  const auto ends = std::span(sides.ends).first(whole_ends);
  lone.has_outer_end =
      std::any_of(ends.begin(), ends.end(), [&](const Side& end) { return !is_before_a_face(end, sides.first); });
  lone.has_corner_end = whole_ends < std::min<std::size_t>(2, sides.ends.size());
  if (!settle_sides(pair, sides, camera, lone)) return std::nullopt;
  const auto axis = axis_of(lone.measurement);
  if (!axis) return std::nullopt;
  lone.axis = *axis;
  lone.is_of_faces = lone.is_of_faces || is_of_faces(sides);
  lone.has_unknown_end = sides.has_unknown_end;
  return lone;
}

}  // namespace

double angle_of(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

bool lies_along(const AxisPlane& plane, const AxisEstimate& axis) {
  const double off = std::abs(std::asin(std::clamp(plane.normal.dot(axis.axis), -1.0, 1.0)));
  const double sigma =
      std::hypot(plane.sigma_rad(axis.axis), std::sqrt(plane.normal.dot(axis.covariance * plane.normal)));
  return off < kMaxSigmas * sigma + kAngleSlack_rad;
}

bool lies_in(const AxisPlanes& planes, const AxisEstimate& axis) {
  return std::all_of(planes.begin(), planes.end(), [&](const AxisPlane& plane) { return lies_along(plane, axis); });
}

std::optional<PanelHypothesis> lone_panel(const MeasuredPair& one, const PinholeCamera& camera) {
  const std::size_t whole_ends = one.sides.ends.size();
  std::optional<PanelHypothesis> lone = lone_with(one.pair, with_corner_ends(one.sides), whole_ends, camera);
  if (one.sides.corner_ends.empty() || (lone && !is_contradicted(*lone))) return lone;
  lone = lone_with(one.pair, one.sides, whole_ends, camera);
  if (lone) lone->has_slanted_end = true;
  return lone;
}

std::optional<PanelHypothesis> wing_of(const MeasuredPair& a, const MeasuredPair& b, const PinholeCamera& camera) {
  PanelHypothesis wing{{a.pair, b.pair}, measurement_of({a.sides, b.sides}, camera), {}, 0.0};
  const auto axis = axis_of(wing.measurement);
  if (!axis) return std::nullopt;
  wing.axis = *axis;
  wing.whole_ends = wing.measurement.short_edges.size();
  std::vector<Side> ends = a.sides.ends;
  ends.insert(ends.end(), b.sides.ends.begin(), b.sides.ends.end());
  if (!settle_wing(ends, camera, wing)) return std::nullopt;
  wing.score = kWingBonus * (a.pair.middle.length() + b.pair.middle.length());
  return wing;
}

bool is_contradicted(const PanelHypothesis& h) {
  const auto square = square_of(h.measurement, h.axis);
  if (square && square->off_rad > kMaxSigmas * square->sigma_rad + kAngleSlack_rad) return true;
  // The sides of a wing's two panels are parallel in space.
  return !lies_in(h.measurement.long_planes, h.axis);
}

bool has_square_ends(const PanelHypothesis& h) {
  const auto square = square_of(h.measurement, h.axis);
  return square && square->sigma_rad < kMaxSquareSigma_rad;
}

bool corners_close(const PanelHypothesis& h) {
  const PanelMeasurement& panel = h.measurement;
  const Segment& first = panel.long_edges.front();
  const Segment& last = panel.long_edges.back();
  const double slack_px = kCornersApart_px + kCornersApartFraction * std::max(first.length(), last.length());
  const auto whole_ends = panel.short_edges.begin() + static_cast<std::ptrdiff_t>(h.whole_ends);
  return std::all_of(panel.short_edges.begin(), whole_ends, [&](const Segment& end) {
    return std::abs(beyond_side_px(first, end) - beyond_side_px(last, end)) < slack_px;
  });
}

}  // namespace pharos::pointing
