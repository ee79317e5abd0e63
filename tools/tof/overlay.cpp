// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/overlay.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "host/images/canvas.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"
#include "tools/tof/pose_summary.hpp"

namespace pharos::tools {
namespace {

using host::Canvas;
using host::Place;
namespace colours = host::colours;

std::optional<Place> place_of(const DepthCamera& camera, const Vector3& point_camera_m) {
  const auto pixel = project(camera.intrinsics, point_camera_m);
  if (!pixel) return std::nullopt;
  return Place{pixel->x(), pixel->y()};
}

void draw_arcs(Canvas& canvas, const ellipse::EllipseWorkspace& found) {
  for (const ellipse::Arc& arc : found.arcs) {
    std::vector<Place> places;
    for (std::uint32_t i = arc.begin; i < arc.end; ++i) {
      places.push_back({static_cast<double>(found.ordered[i].u_px), static_cast<double>(found.ordered[i].v_px)});
    }
    canvas.polyline(places, colours::kGrey, 1.0);
  }
}

void draw_ellipses(Canvas& canvas, const ellipse::EllipseWorkspace& found) {
  for (const ellipse::DetectedEllipse& one : found.found) {
    const ellipse::Ellipse& e = one.ellipse;
    canvas.ellipse({e.cx_px, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colours::kBlue, 1.0, true);
  }
}

void draw_circle(Canvas& canvas, const DepthCamera& camera, const tof::RingModel& ring, tof::RingEdge edge) {
  constexpr int kPieces = 180;
  const tof::PlaneAxes axes = tof::axes_of(ring.normal);
  std::vector<Place> places;
  for (int k = 0; k <= kPieces; ++k) {
    const double angle = kTwoPi * k / kPieces;
    const Vector3 point =
        ring.centre_m + ring.radius(edge) * (std::cos(angle) * axes.first + std::sin(angle) * axes.second);
    if (const auto place = place_of(camera, point)) places.push_back(*place);
  }
  canvas.polyline(places, colours::kGreen, 2.0);
}

void draw_edge_points(Canvas& canvas, const DepthCamera& camera, const tof::TofWorkspace& workspace) {
  for (const tof::RingEdgePoints& points : workspace.edges.points) {
    for (std::size_t i = 0; i < points.size(); i += 4) {
      const auto place = place_of(camera, points[i].point_m);
      if (!place) continue;
      const Vector2 off = points[i].offset_px * points[i].normal_px;
      canvas.dot({place->u_px + off.x(), place->v_px + off.y()}, colours::kYellow, 1.5);
    }
  }
}

void draw_rectangle(Canvas& canvas, const DepthCamera& camera, const tof::RingModel& ring,
                    const tof::PlanarRectangle& rectangle, double height_m, host::Colour colour, double width) {
  const tof::PlaneAxes axes = tof::axes_of(ring.normal);
  const Vector2 along(std::cos(rectangle.angle_rad), std::sin(rectangle.angle_rad));
  const Vector2 across(-along.y(), along.x());
  constexpr std::array<std::array<int, 2>, 5> kCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
  std::vector<Place> places;
  for (const auto& [s, t] : kCorners) {
    const Vector2 plan =
        rectangle.centre_m + s * rectangle.half_sides_m.x() * along + t * rectangle.half_sides_m.y() * across;
    const auto place =
        place_of(camera, ring.centre_m + plan.x() * axes.first + plan.y() * axes.second + height_m * ring.normal);
    if (place) places.push_back(*place);
  }
  canvas.polyline(places, colour, width);
}

// What stands on the plate: connectors' shapes, others, and the one that gives the turn.
void draw_boxes(Canvas& canvas, const DepthCamera& camera, const tof::TofPose& pose,
                const tof::RaisedWorkspace& found) {
  const tof::RingModel& ring = pose.ring.fit.model;
  for (const tof::RaisedBox& box : found.boxes) {
    const bool connector = box.verdict == tof::BoxVerdict::kConnector;
    draw_rectangle(canvas, camera, ring, box.rectangle, box.height_m, connector ? colours::kPink : colours::kSky, 1.5);
  }
  if (pose.has_turn()) {
    draw_rectangle(canvas, camera, ring, pose.connector.rectangle, pose.connector.height_m, colours::kOrange, 2.5);
  }
}

void draw_axes(Canvas& canvas, const DepthCamera& camera, const tof::TofPose& pose) {
  const auto origin = place_of(camera, pose.target.pose.t);
  if (!origin) return;
  const double length = 0.6 * pose.ring.fit.model.radius_m[0];
  constexpr std::array kColours = {colours::kRed, colours::kGreen, colours::kSky};
  constexpr std::array kNames = {"X'", "Y'", "Z'"};
  for (int axis = pose.has_turn() ? 0 : 2; axis < 3; ++axis) {
    const auto tip = place_of(camera, pose.target.pose * Vector3(length * Vector3::Unit(axis)));
    if (!tip) continue;
    const auto k = static_cast<std::size_t>(axis);
    canvas.arrow(*origin, *tip, kColours[k], 3.0);
    canvas.text(*tip, kNames[k], kColours[k]);
  }
  canvas.cross(*origin, colours::kWhite);
}

std::vector<std::string> words_of(const tof::TofPose& pose) {
  const PoseNumbers n = numbers_of(pose.target.pose);
  const PoseNumbers s = sigmas_of(pose.target);
  std::vector<std::string> words;
  words.push_back(
      fmt::format("x {:.2f} y {:.2f} z {:.2f} mm   sigma {:.2f} {:.2f} {:.2f}", n[0], n[1], n[2], s[0], s[1], s[2]));
  if (pose.has_turn()) {
    words.push_back(fmt::format("alpha {:.3f} beta {:.3f} gamma {:.3f} deg   sigma {:.3f} {:.3f} {:.3f}", n[3], n[4],
                                n[5], s[3], s[4], s[5]));
  } else {
    words.push_back(
        fmt::format("alpha {:.3f} beta {:.3f} deg, gamma unknown   sigma {:.3f} {:.3f}", n[3], n[4], s[3], s[4]));
  }
  words.push_back(fmt::format("ring {:.1f} / {:.1f} mm radius, {:.0f} % seen, edges {:.2f} px, plane {:.1f} mm",
                              kMmPerM * pose.ring.fit.model.radius_m[0], kMmPerM * pose.ring.fit.model.radius_m[1],
                              100.0 * pose.ring.fit.seen, pose.ring.fit.edge_rms_px,
                              kMmPerM * pose.ring.fit.plane_rms_m));
  if (pose.flags != 0) words.push_back(host::joined_flags(pose.flags, tof::kTofFlagWords));
  if (pose.ambiguous()) words.emplace_back("ambiguous: two connectors are equally near");
  return words;
}

}  // namespace

void write_overlay(const std::string& path, const tof::TofFrame& frame, const DepthCamera& camera,
                   const Result<tof::TofPose, tof::TofFailure>& pose, const tof::TofWorkspace& workspace) {
  Canvas canvas(frame.intensity, Canvas::zoom_for(frame.intensity.width_px));
  if (pose) draw_boxes(canvas, camera, *pose, workspace.raised);
  draw_arcs(canvas, workspace.ellipse);
  draw_ellipses(canvas, workspace.ellipse);
  std::vector<std::string> words;
  if (pose) {
    for (const tof::RingEdge edge : tof::kRingEdges) draw_circle(canvas, camera, pose->ring.fit.model, edge);
    draw_edge_points(canvas, camera, workspace);
    draw_axes(canvas, camera, *pose);
    words = words_of(*pose);
  } else {
    words.push_back(std::string("refused at stage ") + tof::stage_of(pose.error()) + ": " +
                    tof::describe(pose.error()));
  }
  for (std::size_t line = 0; line < words.size(); ++line) {
    const double row = 4.0 + 20.0 * static_cast<double>(line) / canvas.zoom();
    canvas.text({4.0, row}, words[line], pose ? colours::kWhite : colours::kOrange);
  }
  canvas.write_png(path);
}

}  // namespace pharos::tools
