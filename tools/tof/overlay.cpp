// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/overlay.hpp"

#include <fmt/format.h>

#include <vector>

#include "host/images/canvas.hpp"
#include "host/preview/tof_drawing.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"
#include "tools/tof/pose_summary.hpp"

namespace pharos::tools {
namespace {

using host::Canvas;
using host::Place;
namespace colours = host::colours;

void draw_arcs(Canvas& canvas, const ellipse::EllipseWorkspace& found) {
  for (const ellipse::Arc& arc : found.arcs) {
    std::vector<Place> places;
    for (std::uint32_t i = arc.begin; i < arc.end; ++i) {
      places.push_back({static_cast<double>(found.ordered[i].u_px), static_cast<double>(found.ordered[i].v_px)});
    }
    canvas.polyline(places, colours::kGrey, 1.0);
  }
}

void draw_edge_points(Canvas& canvas, const DepthCamera& camera, const tof::TofWorkspace& workspace) {
  for (const tof::RingEdgePoints& points : workspace.edges.points) {
    for (std::size_t i = 0; i < points.size(); i += 4) {
      const auto place = host::place_of(camera.intrinsics, points[i].point_m);
      if (!place) continue;
      const Vector2 off = points[i].offset_px * points[i].normal_px;
      canvas.dot({place->u_px + off.x(), place->v_px + off.y()}, colours::kYellow, 1.5);
    }
  }
}

// What stands on the plate: connectors' shapes, and others.
void draw_boxes(Canvas& canvas, const DepthCamera& camera, const tof::RingModel& ring,
                const tof::RaisedWorkspace& found) {
  host::Drawing drawing;
  for (const tof::RaisedBox& box : found.boxes) {
    const bool connector = box.verdict == tof::BoxVerdict::kConnector;
    host::add_rectangle(drawing, camera, ring, box.rectangle, box.height_m, connector ? colours::kPink : colours::kSky,
                        1.5);
  }
  drawing.draw(canvas);
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
  if (pose) draw_boxes(canvas, camera, pose->ring.fit.model, workspace.raised);
  draw_arcs(canvas, workspace.ellipse);
  host::ellipses_drawing(workspace.ellipse).draw(canvas);
  std::vector<std::string> words;
  if (pose) {
    host::tof_drawing(*pose, camera).draw(canvas);
    draw_edge_points(canvas, camera, workspace);
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
