// SPDX-License-Identifier: Apache-2.0
#include "host/preview/tof_drawing.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "host/preview/circle_points.hpp"

namespace pharos::host {
namespace {

void add_circle(Drawing& drawing, const DepthCamera& camera, const tof::RingModel& ring, tof::RingEdge edge) {
  const tof::PlaneAxes axes = tof::axes_of(ring.normal);
  std::vector<Place> places;
  for (const Vector3& point : circle_points(ring.centre_m, axes.first, axes.second, ring.radius(edge))) {
    if (const auto place = place_of(camera.intrinsics, point)) places.push_back(*place);
  }
  drawing.polyline(std::move(places), colours::kGreen, 2.0);
}

void add_axes(Drawing& drawing, const DepthCamera& camera, const tof::TofPose& pose) {
  const auto origin = place_of(camera.intrinsics, pose.target.pose.t);
  if (!origin) return;
  const double length = 0.6 * pose.ring.fit.model.radius_m[0];
  constexpr std::array kColours = {colours::kRed, colours::kGreen, colours::kSky};
  constexpr std::array kNames = {"X'", "Y'", "Z'"};
  for (int axis = pose.has_turn() ? 0 : 2; axis < 3; ++axis) {
    const auto tip = place_of(camera.intrinsics, pose.target.pose * Vector3(length * Vector3::Unit(axis)));
    if (!tip) continue;
    const auto k = static_cast<std::size_t>(axis);
    drawing.arrow(*origin, *tip, kColours[k], 3.0);
    drawing.text(*tip, kNames[k], kColours[k]);
  }
  drawing.cross(*origin, colours::kWhite);
}

}  // namespace

std::optional<Place> place_of(const PinholeCamera& camera, const Vector3& point_camera_m) {
  const auto pixel = project(camera, point_camera_m);
  if (!pixel) return std::nullopt;
  return Place{pixel->x(), pixel->y()};
}

void add_rectangle(Drawing& drawing, const DepthCamera& camera, const tof::RingModel& ring,
                   const tof::PlanarRectangle& rectangle, double height_m, Colour colour, double width) {
  const tof::PlaneAxes axes = tof::axes_of(ring.normal);
  const Vector2 along(std::cos(rectangle.angle_rad), std::sin(rectangle.angle_rad));
  const Vector2 across(-along.y(), along.x());
  constexpr std::array<std::array<int, 2>, 5> kCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
  std::vector<Place> places;
  for (const auto& [s, t] : kCorners) {
    const Vector2 plan =
        rectangle.centre_m + s * rectangle.half_sides_m.x() * along + t * rectangle.half_sides_m.y() * across;
    const auto place = place_of(
        camera.intrinsics, ring.centre_m + plan.x() * axes.first + plan.y() * axes.second + height_m * ring.normal);
    if (place) places.push_back(*place);
  }
  drawing.polyline(std::move(places), colour, width);
}

Drawing tof_drawing(const tof::TofPose& pose, const DepthCamera& camera) {
  Drawing drawing;
  for (const tof::RingEdge edge : tof::kRingEdges) add_circle(drawing, camera, pose.ring.fit.model, edge);
  if (pose.has_turn()) {
    add_rectangle(drawing, camera, pose.ring.fit.model, pose.connector.rectangle, pose.connector.height_m,
                  colours::kOrange, 2.5);
  }
  add_axes(drawing, camera, pose);
  return drawing;
}

Drawing ellipses_drawing(const ellipse::EllipseWorkspace& found) {
  Drawing drawing;
  for (const ellipse::DetectedEllipse& one : found.found) {
    const ellipse::Ellipse& e = one.ellipse;
    drawing.ellipse({e.cx_px, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colours::kBlue, 1.0, true);
  }
  return drawing;
}

}  // namespace pharos::host
