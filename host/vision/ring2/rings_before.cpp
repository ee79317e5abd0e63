// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/rings_before.hpp"

#include <limits>
#include <optional>

#include "pharos/ring2/refine.hpp"

namespace pharos::host {
namespace {

// Error of an ellipse with some points of other edges.
constexpr double kLooseSystematic_px = 1.5;
// Of the fit to five parameters of an ellipse: what is farther off is no circle about this axis.
constexpr double kMaxChi2 = 16.0;
// Nearer than this, in radii of the ring found, it is an edge of the same face; and a nozzle is narrower than its ring.
constexpr double kMinAhead = 0.01;
constexpr double kMaxNozzleRadius = 0.75;

// The circle about the axis of `found` whose image is this ellipse: a second circle, of which the distance is free.
std::optional<ring2::CircleModel> circle_about_axis(const ring2::Rig& rig, std::size_t view,
                                                    const ring2::Contour& contour, const ring2::CircleModel& found) {
  ring2::CircleProblem problem;
  problem.rig = rig;
  problem.contours[view][1] = ring2::contour_of(contour.ellipse, kLooseSystematic_px, 1.0);
  problem.free[ring2::kDistance] = problem.free[ring2::kSecondRadius] = true;
  ring2::CircleModel start = found;
  start.distance_m = 0.0;
  const double range_m = (found.centre_m - rig.views[view].T_rig_camera.t).norm();
  start.second_radius_m = contour.ellipse.a_px * range_m / rig.views[view].intrinsics.fx_px;
  const auto refined = ring2::refine(problem, start, std::numeric_limits<double>::infinity());
  if (!refined || !(refined->sums.cost < kMaxChi2)) return std::nullopt;
  return refined->model;
}

}  // namespace

std::vector<RingHypothesis> rings_before(const ring2::Rig& rig,
                                         const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours,
                                         const ring2::CircleModel& found) {
  std::vector<RingHypothesis> rings;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    for (const ring2::Contour& contour : contours[v]) {
      const auto circle = circle_about_axis(rig, v, contour, found);
      if (!circle) continue;
      const double ahead_m = circle->distance_m, radius_m = circle->second_radius_m;
      if (ahead_m < kMinAhead * found.radius_m || found.distance_m - ahead_m < kMinNozzleDistance * radius_m ||
          found.second_radius_m > kMaxNozzleRadius * radius_m) {
        continue;
      }
      RingHypothesis ring;
      ring.has_nozzle = true;
      ring.model = {found.normal, found.centre_m + ahead_m * found.normal, radius_m, found.distance_m - ahead_m,
                    found.second_radius_m};
      rings.push_back(ring);
    }
  }
  return rings;
}

}  // namespace pharos::host
