// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/measure_panel.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/pointing/hypothesis_choice.hpp"
#include "host/vision/pointing/outline.hpp"
#include "host/vision/pointing/tone_error.hpp"
#include "pharos/base/units.hpp"

namespace pharos::pointing {
namespace {

constexpr double kPlaneOnlySigma_rad = 20.0 * kRadPerDeg;
constexpr double kSquareSlack_rad = 0.5 * kRadPerDeg;
constexpr double kLongEdge_px = 30.0;

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

void widen(const ToneError& tone_error, const Matrix3& R_station_camera, AxisEstimate& axis) {
  const Vector3 error = tone_error.sigma * (R_station_camera * tone_error.shift);
  axis.covariance += error * error.transpose();
  axis.sigma_along_rad = std::hypot(axis.sigma_along_rad, error.norm());
}

}  // namespace

Result<PanelMeasurement, PointingRefusal> measure_panel(ImageView<const std::uint16_t> image,
                                                        const PinholeCamera& camera) {
  if (image.width_px != camera.width_px || image.height_px != camera.height_px) return PointingRefusal::kWrongSize;
  const auto target = find_target(image);
  if (!target) return target.error();
  const std::vector<Segment> outline = outline_edges(image, *target);
  const std::vector<EdgePair> pairs = facing_pairs(outline, *target);
  if (pairs.empty()) return why_no_panel(outline, *target, image);
  Result<PanelMeasurement, PointingRefusal> result = choose_panel(image, *target, camera, outline, pairs);
  if (result) (*result).outline = outline;
  return result;
}

PointingResult answer_of(const PanelMeasurement& panel, const pointing::LineOfSight& sight, Tone tone) {
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
  if (tone == Tone::kUnknown) widen(tone_error(panel), R, result.axis);
  if (!panel.other_planes.empty()) {
    const auto other = pointing::estimate_axis({panel.other_planes.data(), panel.other_planes.size()});
    if (other) result.second_axis = pointing::signed_axis(R * other->axis);
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
