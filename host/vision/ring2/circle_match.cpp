// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/circle_match.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

using ring2::Contour;
using ring2::Rig;

// Tolerances before any fit. The centre of an ellipse differs from the image of its circle's centre by some hundredths
// of the range, and the size from the long axis by as much.
constexpr double kMaxGapPerRange = 0.04;
constexpr double kMaxSizeRatio = 1.25;
// Tolerances for parallel circles on one axis, measured by single pairs: a nozzle's own tilt is accurate to half a
// degree.
constexpr double kMaxTilt = 6.0 * kRadPerDeg;
constexpr double kMaxOffAxisPerRadius = 0.05;
// Maximum radius of a nozzle and maximum distance from its ring, both as factors of the ring's radius.
constexpr double kMaxNozzlePerRing = 0.75;
constexpr double kMaxDistancePerRing = 3.0;
// Edges of one rim: circles nearer along the axis than this fraction of the ring's radius are in one plane.
constexpr double kOnePlanePerRing = 0.04;

std::optional<Vector3> ray_of(const ring2::RigView& view, const Contour& contour) {
  const auto ray = undistort(view.intrinsics, contour.centre_px);
  if (!ray) return std::nullopt;
  return (view.T_rig_camera.R * Vector3(ray->x(), ray->y(), 1.0)).eval();
}

// Depths along both rays at their closest points; empty if these are behind a camera or the rays do not intersect.
std::optional<std::array<double, 2>> meeting_of(const Vector3& left, const Vector3& right, const Vector3& baseline) {
  // left s - right t = baseline, least squares.
  const double a = left.dot(left), b = left.dot(right), c = right.dot(right);
  const double determinant = a * c - b * b;
  if (!(determinant > 1e-12 * a * c)) return std::nullopt;
  const double s = (c * left.dot(baseline) - b * right.dot(baseline)) / determinant;
  const double t = (b * left.dot(baseline) - a * right.dot(baseline)) / determinant;
  if (!(s > 0.0 && t > 0.0)) return std::nullopt;
  const double gap = (left * s - right * t - baseline).norm();
  if (gap > kMaxGapPerRange * std::min(s, t)) return std::nullopt;
  return std::array<double, 2>{s, t};
}

bool sizes_agree(const Rig& rig, const Contour& left, const Contour& right, const std::array<double, 2>& depths) {
  const double size_left = left.ellipse.a_px * depths[0] / rig.views[0].intrinsics.fx_px;
  const double size_right = right.ellipse.a_px * depths[1] / rig.views[1].intrinsics.fx_px;
  return std::max(size_left, size_right) < kMaxSizeRatio * std::min(size_left, size_right);
}

std::optional<MatchedCircle> match_of(const Rig& rig, const Contour& left, const Contour& right) {
  const auto ray_left = ray_of(rig.views[0], left);
  const auto ray_right = ray_of(rig.views[1], right);
  if (!ray_left || !ray_right) return std::nullopt;
  const Vector3 baseline = rig.views[1].T_rig_camera.t - rig.views[0].T_rig_camera.t;
  const auto depths = meeting_of(*ray_left, *ray_right, baseline);
  if (!depths || !sizes_agree(rig, left, right, *depths)) return std::nullopt;
  ring2::ContourSet pair;
  pair[0][0] = left;
  pair[1][0] = right;
  const auto fit = ring2::solve_ring2(rig, pair);
  if (!fit) return std::nullopt;
  return MatchedCircle{{}, fit->ring_centre_m, fit->normal, fit->ring_radius_m};
}

// Position of a circle's centre along the ring's axis, if it may be the ring's nozzle.
std::optional<double> distance_along(const MatchedCircle& ring, const MatchedCircle& nozzle) {
  if (nozzle.radius_m > kMaxNozzlePerRing * ring.radius_m) return std::nullopt;
  if (nozzle.normal.dot(ring.normal) < std::cos(kMaxTilt)) return std::nullopt;
  const Vector3 between = nozzle.centre_m - ring.centre_m;
  const double along = between.dot(ring.normal);
  const double off = (between - along * ring.normal).norm();
  // An error of one degree in the ring's tilt moves its axis by a fiftieth of the distance.
  if (off > kMaxOffAxisPerRadius * (ring.radius_m + std::abs(along))) return std::nullopt;
  if (std::abs(along) > kMaxDistancePerRing * ring.radius_m) return std::nullopt;
  return along;
}

// The nozzle of a ring: the circle nearest to the cameras; among the edges of one rim the widest.
const MatchedCircle* nozzle_of(const MatchedCircle& ring, std::span<const MatchedCircle> circles) {
  const MatchedCircle* best = nullptr;
  double best_along = 0.0;
  for (const MatchedCircle& circle : circles) {
    const std::optional<double> along = distance_along(ring, circle);
    if (!along) continue;
    const double plane = kOnePlanePerRing * ring.radius_m;
    const bool nearer = best != nullptr && *along > best_along + plane;
    const bool wider = best != nullptr && *along > best_along - plane && circle.radius_m > best->radius_m;
    if (best != nullptr && !nearer && !wider) continue;
    best = &circle;
    best_along = *along;
  }
  return best;
}

}  // namespace

std::vector<MatchedCircle> matched_circles(const Rig& rig,
                                           const std::array<std::vector<Contour>, ring2::kViews>& contours) {
  std::vector<MatchedCircle> circles;
  for (std::size_t i = 0; i < contours[0].size(); ++i) {
    for (std::size_t j = 0; j < contours[1].size(); ++j) {
      std::optional<MatchedCircle> circle = match_of(rig, contours[0][i], contours[1][j]);
      if (!circle) continue;
      circle->index = {i, j};
      circles.push_back(*circle);
    }
  }
  return circles;
}

RingAndNozzleChoice choose_circles(std::span<const MatchedCircle> circles) {
  RingAndNozzleChoice choice;
  for (const MatchedCircle& circle : circles) {
    const MatchedCircle* nozzle = nozzle_of(circle, circles);
    const bool better = choice.ring == nullptr || (nozzle != nullptr && choice.nozzle == nullptr) ||
                        ((nozzle != nullptr) == (choice.nozzle != nullptr) && circle.radius_m > choice.ring->radius_m);
    if (better) choice = {&circle, nozzle};
  }
  return choice;
}

}  // namespace pharos::host
