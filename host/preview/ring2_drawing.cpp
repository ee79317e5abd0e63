// SPDX-License-Identifier: Apache-2.0
#include "host/preview/ring2_drawing.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "host/preview/circle_points.hpp"

namespace pharos::host {
namespace {

class RigDrawing {
 public:
  explicit RigDrawing(const ring2::RigView& view) : view_(view), T_camera_rig_(view.T_rig_camera.inverse()) {}

  void ellipse(const ellipse::Ellipse& e, Colour colour, double width, bool dashed) {
    drawing_.ellipse({e.cx_px, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colour, width, dashed);
  }
  void circle(const Vector3& centre_m, const Vector3& normal, double radius_m, Colour colour) {
    const auto axes = ring2::tilt_axes(normal);
    std::vector<Place> places;
    for (const Vector3& point : circle_points(centre_m, axes[0], axes[1], radius_m)) {
      if (const auto place = place_of(point)) places.push_back(*place);
    }
    drawing_.polyline(std::move(places), colour, 1.5);
  }
  void arrow(const Vector3& from_m, const Vector3& to_m, Colour colour) {
    const auto from = place_of(from_m);
    const auto to = place_of(to_m);
    if (from && to) drawing_.arrow(*from, *to, colour, 3.0);
  }
  Drawing take() { return std::move(drawing_); }

 private:
  std::optional<Place> place_of(const Vector3& point_rig_m) const {
    const auto pixel = project(view_.intrinsics, T_camera_rig_ * point_rig_m);
    if (!pixel) return std::nullopt;
    return Place{pixel->x(), pixel->y()};
  }

  const ring2::RigView& view_;
  Pose<frame::Camera, frame::Rig> T_camera_rig_;
  Drawing drawing_;
};

void add_estimate(RigDrawing& drawing, const ring2::Ring2Estimate& e) {
  if ((e.unobservable & ring2::kUnobservableScale) != 0) return;
  const bool ring = (e.unobservable & ring2::kUnobservableRing) == 0;
  const bool nozzle = (e.unobservable & ring2::kUnobservableNozzle) == 0;
  if (ring) drawing.circle(e.ring_centre_m, e.normal, e.ring_radius_m, colours::kGreen);
  if (nozzle) drawing.circle(e.nozzle_centre_m, e.normal, e.nozzle_radius_m, colours::kYellow);
  const Vector3& foot = ring ? e.ring_centre_m : e.nozzle_centre_m;
  drawing.arrow(foot, foot + e.normal * (ring ? e.ring_radius_m : 3.0 * e.nozzle_radius_m), colours::kOrange);
}

}  // namespace

Drawing ring2_drawing(const Ring2Detection& circles, const ring2::Rig& rig, std::size_t view) {
  RigDrawing drawing(rig.views[view]);
  for (const ellipse::DetectedEllipse& found : circles.found[view]) {
    drawing.ellipse(found.ellipse, colours::kGrey, 1.0, true);
  }
  for (const auto& contour : circles.contours[view]) {
    if (contour) drawing.ellipse(contour->ellipse, colours::kSky, 3.0, false);
  }
  if (circles.estimate) add_estimate(drawing, *circles.estimate);
  return drawing.take();
}

}  // namespace pharos::host
