// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/measure_panel.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/pointing/edge_points.hpp"
#include "host/vision/pointing/outline.hpp"
#include "host/vision/pointing/panel_choice.hpp"
#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

using pointing::AxisEstimate;
using pointing::AxisPlanes;
using pointing::EdgePoint;
using pointing::LineFit;

constexpr double kReachFraction = 0.45;    // of the distance to the opposite edge
constexpr double kMinSeenFraction = 0.45;  // of a short edge's length
constexpr double kOneLineChi2 = 18.0;      // of two edges fitted as one line, two degrees of freedom: 99.99 %
constexpr double kMinAspect = 1.3;         // of a lone panel; a body is as long as wide
constexpr double kSureSigma_rad = 5.0 * kRadPerDeg;
constexpr double kPlaneOnlySigma_rad = 20.0 * kRadPerDeg;
constexpr double kSquareSlack_rad = 0.5 * kRadPerDeg;
constexpr double kLongEdge_px = 30.0;

// One side of a panel: its points in the ideal image and the line through them.
struct Side {
  std::vector<EdgePoint> points;
  LineFit fit;
  Segment extent;  // in the distorted image
  double blur_px = 0.0;
  bool cut = false;
};

struct Panel {
  Side first, second;
  std::vector<Side> ends;
};

Result<Side, PointingRefusal> measured_side(ImageView<const std::uint16_t> image, const TargetMask& target,
                                            const PinholeCamera& camera, const Segment& guess, double reach_px) {
  MeasuredEdge edge = measure_edge(image, target, guess, reach_px);
  Side side;
  side.cut = edge.cut;
  side.blur_px = edge.blur_px;
  side.extent = edge.extent;
  side.points = std::move(edge.points);
  if (!pointing::undo_distortion(side.points, camera)) return PointingRefusal::kOutsideLens;
  const auto fit = pointing::fit_line(side.points);
  if (!fit) return side.cut ? PointingRefusal::kCutByBorder : PointingRefusal::kEdgeUnsure;
  side.fit = *fit;
  return side;
}

// The ends of a panel: from the end of each long side to the beginning of the other.
void measure_ends(ImageView<const std::uint16_t> image, const TargetMask& target, const PinholeCamera& camera,
                  Panel& panel) {
  for (const auto& [from, to] : {std::pair{panel.first.extent.end, panel.second.extent.begin},
                                 {panel.second.extent.end, panel.first.extent.begin}}) {
    const Segment guess{from, to};
    const double reach = kReachFraction * std::min(panel.first.extent.length(), panel.second.extent.length());
    if (guess.length() < 4.0) continue;
    const auto side = measured_side(image, target, camera, guess, reach);
    if (!side || side->cut || side->fit.length_px() < kMinSeenFraction * guess.length()) continue;
    panel.ends.push_back(*side);
  }
}

Result<Panel, PointingRefusal> measured_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                              const PinholeCamera& camera, const EdgePair& pair) {
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
  Panel panel{*first, *second, {}};
  measure_ends(image, target, camera, panel);
  return panel;
}

double squares(const LineFit& fit) { return fit.rms_px * fit.rms_px * static_cast<double>(fit.points); }

// Two edges that are parts of one line: the joint fit, if it is not worse than the separate ones.
std::optional<LineFit> as_one_line(const Side& a, const Side& b) {
  std::vector<EdgePoint> points = a.points;
  points.insert(points.end(), b.points.begin(), b.points.end());
  const Vector2 along = a.extent.along();
  std::sort(points.begin(), points.end(),
            [&](const EdgePoint& p, const EdgePoint& q) { return along.dot(p.place_px) < along.dot(q.place_px); });
  const auto fit = pointing::fit_line(points);
  if (!fit || fit->points + 8 < a.fit.points + b.fit.points) return std::nullopt;
  const double apart = squares(a.fit) + squares(b.fit);
  const double variance = apart / static_cast<double>(a.fit.points + b.fit.points - 4);
  const double worse = (squares(*fit) - apart) / std::max(1e-12, variance);
  const double correlated = std::max(a.fit.variance_inflation, b.fit.variance_inflation);
  if (worse > kOneLineChi2 * correlated) return std::nullopt;
  return *fit;
}

void add_plane(AxisPlanes& planes, std::vector<Segment>& edges, const LineFit& fit, const PinholeCamera& camera) {
  planes.push_back(pointing::plane_of_line(fit.line, camera));
  edges.push_back({fit.begin_px, fit.end_px});
}

// A wing's four long edges as two lines, where they fit.
void add_long_sides(PanelMeasurement& result, const std::vector<Panel>& panels, const PinholeCamera& camera) {
  if (panels.size() == 1) {
    add_plane(result.long_planes, result.long_edges, panels[0].first.fit, camera);
    add_plane(result.long_planes, result.long_edges, panels[0].second.fit, camera);
    return;
  }
  for (const Side* one : {&panels[0].first, &panels[0].second}) {
    // Edges with the same orientation are on the same side of the wing.
    const bool same_way = one->extent.along().dot(panels[1].first.extent.along()) > 0.0;
    const Side& other = same_way ? panels[1].first : panels[1].second;
    if (const auto both = as_one_line(*one, other)) {
      add_plane(result.long_planes, result.long_edges, *both, camera);
    } else {
      add_plane(result.long_planes, result.long_edges, one->fit, camera);
      add_plane(result.long_planes, result.long_edges, other.fit, camera);
    }
  }
}

PanelMeasurement measurement_of(const std::vector<Panel>& panels, const PinholeCamera& camera) {
  PanelMeasurement result;
  result.panels = static_cast<int>(panels.size());
  add_long_sides(result, panels, camera);
  double square = 0.0, points = 0.0;
  for (const Panel& panel : panels) {
    for (const Side* side : {&panel.first, &panel.second}) {
      square += squares(side->fit);
      points += static_cast<double>(side->fit.points);
      result.blur_px += 0.5 * side->blur_px / static_cast<double>(panels.size());
    }
    for (const Side& end : panel.ends) {
      if (!result.short_planes.full()) add_plane(result.short_planes, result.short_edges, end.fit, camera);
    }
  }
  result.rms_px = std::sqrt(square / points);
  if (panels.size() == 1) result.flags |= kFlagOnePanel;
  return result;
}

// Ratio of the long sides to the short ones in space, from perspective; empty where it is not determined. One end
// suffices: it is perpendicular to the axis.
std::optional<double> aspect_in_space(const PanelMeasurement& panel, const PinholeCamera& camera) {
  if (panel.short_planes.empty() || panel.long_planes.size() != 2) return std::nullopt;
  const auto axis = pointing::estimate_axis({panel.long_planes.data(), 2});
  if (!axis || axis->sigma_rad() > kSureSigma_rad) return std::nullopt;
  const Vector3& end = panel.short_planes[0].normal;
  const Vector3 normal = axis->axis.cross(axis->axis.cross(end)).normalized();
  const auto on_panel = [&](const Vector3& ray) { return Vector3(ray / normal.dot(ray)); };
  const auto ray_of = [&](const Vector2& place) {
    return Vector3((place.x() - camera.cx_px) / camera.fx_px, (place.y() - camera.cy_px) / camera.fy_px, 1.0);
  };
  double length = 0.0;
  std::array<Vector3, 2> corners;
  for (std::size_t i = 0; i < 2; ++i) {
    corners[i] = on_panel(panel.long_planes[i].normal.cross(end));
    for (const Vector2& place : {panel.long_edges[i].begin, panel.long_edges[i].end}) {
      length = std::max(length, (on_panel(ray_of(place)) - corners[i]).norm());
    }
  }
  return length / (corners[0] - corners[1]).norm();
}

PointingRefusal why_no_panel(const std::vector<Segment>& edges, const TargetMask& target,
                             ImageView<const std::uint16_t> image) {
  const auto outside = [&](const Vector2& p) {
    return p.x() < 4.0 || p.y() < 4.0 || p.x() > image.width_px - 5.0 || p.y() > image.height_px - 5.0;
  };
  if (target.has_brighter_star) return PointingRefusal::kStarsBrighter;
  if (edges.empty() || edges.front().length() < kLongEdge_px) return PointingRefusal::kNoPanel;
  if (outside(edges.front().begin) || outside(edges.front().end)) return PointingRefusal::kCutByBorder;
  return PointingRefusal::kOneEdge;
}

}  // namespace

Result<PanelMeasurement, PointingRefusal> measure_panel(ImageView<const std::uint16_t> image,
                                                        const PinholeCamera& camera) {
  if (image.width_px != camera.width_px || image.height_px != camera.height_px) return PointingRefusal::kWrongSize;
  const auto target = find_target(image);
  if (!target) return target.error();
  const std::vector<Segment> outline = outline_edges(image, *target);
  const auto choice = choose_panels(outline, *target);
  if (!choice) return why_no_panel(outline, *target, image);
  std::vector<Panel> panels;
  std::optional<PointingRefusal> refusal;
  for (const EdgePair& pair : choice->panels) {
    const auto panel = measured_panel(image, *target, camera, pair);
    if (panel) {
      panels.push_back(*panel);
    } else {
      refusal = panel.error();
    }
  }
  if (panels.empty()) return *refusal;
  PanelMeasurement result = measurement_of(panels, camera);
  if (choice->panels.size() == 1) {
    const EdgePair& pair = choice->panels[0];
    double aspect = pair.middle.length() / pair.separation;
    if (const auto in_space = aspect_in_space(result, camera)) {
      aspect = std::max(*in_space, 1.0 / *in_space);
      if (*in_space < 1.0) {
        if (result.short_planes.size() < 2) return PointingRefusal::kNoPanel;
        std::swap(result.long_planes, result.short_planes);
        std::swap(result.long_edges, result.short_edges);
      }
    }
    if (aspect < kMinAspect) return PointingRefusal::kNoPanel;
  }
  if (refusal == PointingRefusal::kCutByBorder) result.flags |= kFlagPanelCut;
  result.outline = outline;
  return result;
}

PointingResult answer_of(const PanelMeasurement& panel, const pointing::LineOfSight& sight) {
  const Matrix3 R = pointing::camera_to_station(sight);
  PointingResult result;
  result.flags = panel.flags;
  for (const pointing::AxisPlane& plane : panel.long_planes)
    result.planes_station.push_back(pointing::rotated(plane, R));
  const auto axis = pointing::estimate_axis({result.planes_station.data(), result.planes_station.size()});
  if (!axis) return result;  // two finite planes always have an axis
  result.axis = *axis;
  result.axis.axis = pointing::signed_axis(axis->axis);
  // Edges that contradict each other have a larger uncertainty than stated for each.
  if (axis->degrees_of_freedom > 0) {
    const double widening = std::max(1.0, axis->chi2 / axis->degrees_of_freedom);
    result.axis.covariance *= widening;
    result.axis.sigma_along_rad *= std::sqrt(widening);
    result.axis.sigma_plane_rad *= std::sqrt(widening);
  }
  if (result.axis.sigma_along_rad > kPlaneOnlySigma_rad) result.flags |= kFlagPlaneOnly;
  if (panel.short_planes.size() >= 2) {
    const auto across = pointing::estimate_axis({panel.short_planes.data(), panel.short_planes.size()});
    if (!across) return result;
    const Vector3 side = R * across->axis;
    // Derivative of the angle by either axis: the component towards the other.
    const Vector3& d = result.axis.axis;
    const double cosine = std::clamp(std::abs(d.dot(side)), 0.0, 1.0);
    result.square_rad = std::acos(cosine);
    const Matrix3 covariance = R * across->covariance * R.transpose();
    const double variance = side.dot(result.axis.covariance * side) + d.dot(covariance * d);
    result.sigma_square_rad = std::sqrt(variance);
    if (0.5 * kPi - *result.square_rad > 3.0 * result.sigma_square_rad + kSquareSlack_rad)
      result.flags |= kFlagNotSquare;
  }
  return result;
}

}  // namespace pharos::pointing
