// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/other_ring.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pharos::host {
namespace {

using ellipse::DetectedEllipse;
using ellipse::Ellipse;

// A ring's image of less than this fraction of the chosen ring's is a thruster's or a cover's.
constexpr double kMinSize = 0.7;
// The two edges of a rim: ratio of their axes, distance of their centres and difference of their shapes as fractions of
// the wider one. Rims have faces of 4 to 13 % of their radius.
constexpr double kMinNarrower = 0.80, kMaxNarrower = 0.97;
constexpr double kMaxApart = 0.02;
constexpr double kMaxShape = 0.03;
// Circles with centres nearer than this fraction of the larger one are on the chosen ring's axis: its nozzle, its foot,
// the edge of a round body.
constexpr double kMinAside = 0.7;

double distance_px(const Ellipse& a, const Ellipse& b) { return std::hypot(a.cx_px - b.cx_px, a.cy_px - b.cy_px); }

bool is_face(const Ellipse& wide, const Ellipse& narrow) {
  const double a = narrow.a_px / wide.a_px, b = narrow.b_px / wide.b_px;
  return a > kMinNarrower && a < kMaxNarrower && std::abs(a - b) < kMaxShape &&
         distance_px(wide, narrow) < kMaxApart * wide.a_px;
}

struct RingImage {
  Vector2 centre_px = Vector2::Zero();
  double radius_px = 0.0;
};

std::optional<RingImage> image_of(const ring2::RigView& view, const ring2::Ring2Estimate& estimate) {
  const Vector3 centre_m = view.T_rig_camera.R.transpose() * (estimate.ring_centre_m - view.T_rig_camera.t);
  const auto centre_px = project(view.intrinsics, centre_m);
  if (!centre_px) return std::nullopt;
  return RingImage{*centre_px, view.intrinsics.fx_px * estimate.ring_radius_m / centre_m.z()};
}

bool is_beside(const Ellipse& ellipse, const RingImage& ring) {
  const double apart = std::hypot(ellipse.cx_px - ring.centre_px.x(), ellipse.cy_px - ring.centre_px.y());
  return ellipse.a_px > kMinSize * ring.radius_px && apart > kMinAside * std::max(ellipse.a_px, ring.radius_px);
}

}  // namespace

bool shows_another_ring(const ring2::Rig& rig, const std::array<std::vector<DetectedEllipse>, ring2::kViews>& found,
                        const ring2::Ring2Estimate& estimate) {
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    const auto ring = image_of(rig.views[v], estimate);
    if (!ring) continue;
    for (const DetectedEllipse& wide : found[v]) {
      if (!is_beside(wide.ellipse, *ring)) continue;
      const auto is_inner = [&](const DetectedEllipse& narrow) { return is_face(wide.ellipse, narrow.ellipse); };
      if (std::any_of(found[v].begin(), found[v].end(), is_inner)) return true;
    }
  }
  return false;
}

}  // namespace pharos::host
