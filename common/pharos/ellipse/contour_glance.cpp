// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/contour_glance.hpp"

#include <cmath>

#include "pharos/ellipse/contour_places.hpp"
#include "pharos/ellipse/gradient.hpp"

namespace pharos::ellipse {
namespace {

constexpr int kGlanceAt = 32;
// Of the gradient's length, along the normal: within 37 deg, for a pixel up to 2 px beside the edge.
constexpr double kMinAlong = 0.8;

}  // namespace

double glance_along(const Ellipse& ellipse, bool bright_inside, const EllipseWorkspace& workspace) {
  if (workspace.width_px == 0) return 1.0;
  const ImageView<const std::uint16_t> smoothed(workspace.planes.data(), workspace.width_px, workspace.height_px);
  const double right = smoothed.width_px - 1.0 - kBorder_px, bottom = smoothed.height_px - 1.0 - kBorder_px;
  const double sign = bright_inside ? -1.0 : 1.0, noise = static_cast<double>(workspace.noise);
  double length = 0.0, turn = 0.0, all_length = 0.0, all_turn = 0.0;
  ContourPlaces places(ellipse, kGlanceAt);
  for (int k = 0; k < kGlanceAt; ++k) {
    const ContourPlaces::Place place = places.next();
    const PointPx& p = place.point;
    if (p.u < kBorder_px || p.v < kBorder_px || p.u > right || p.v > bottom) continue;
    // Of one step of the anomaly, but for a factor each.
    const double step_turn = place.per_speed * place.per_speed, step_length = 1.0 / place.per_speed;
    all_length += step_length;
    all_turn += step_turn;
    const Gradient gradient =
        gradient_at(smoothed, static_cast<std::int32_t>(p.u + 0.5), static_cast<std::int32_t>(p.v + 0.5));
    const double u = gradient.u, v = gradient.v, along = sign * (u * place.normal_u + v * place.normal_v);
    if (!(along > noise) || along * along < kMinAlong * kMinAlong * (u * u + v * v)) continue;
    length += step_length;
    turn += step_turn;
  }
  return all_length > 0.0 ? 0.5 * (length / all_length + turn / all_turn) : 0.0;
}

}  // namespace pharos::ellipse
