// SPDX-License-Identifier: Apache-2.0
#include "tools/ellipses/overlay.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace pharos::tools {
namespace {

constexpr std::array<host::Colour, 5> kArcColours = {
    host::colours::kGreen, host::colours::kYellow, host::colours::kPink, host::colours::kBlue, host::colours::kOrange};

host::Place place_of(const ellipse::EdgePoint& p) { return {static_cast<double>(p.u_px), static_cast<double>(p.v_px)}; }

}  // namespace

void draw_arcs(const ellipse::EllipseWorkspace& workspace, host::Canvas& canvas) {
  for (const ellipse::EdgePoint& p : workspace.ordered) canvas.dot(place_of(p), host::colours::kGrey, 0.5);
  std::size_t number = 0;
  for (const ellipse::Arc& arc : workspace.arcs) {
    std::vector<host::Place> places;
    for (std::uint32_t k = arc.begin; k < arc.end; ++k) places.push_back(place_of(workspace.ordered[k]));
    canvas.polyline(places, kArcColours[number++ % kArcColours.size()], 1.2);
  }
}

void draw_ellipses(std::span<const ellipse::DetectedEllipse> ellipses, host::Canvas& canvas) {
  std::size_t number = 0;
  for (const ellipse::DetectedEllipse& found : ellipses) {
    const ellipse::Ellipse& e = found.ellipse;
    const host::Colour colour = found.bright_inside ? host::colours::kRed : host::colours::kSky;
    canvas.ellipse({e.cx_px, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colour, 2.5);
    canvas.cross({e.cx_px, e.cy_px}, colour);
    std::array<char, 32> label{};
    std::snprintf(label.data(), label.size(), "%zu %.2f", ++number, found.score);
    // On the contour, at different angles: labels of concentric ellipses would overlap.
    const ellipse::PointPx at = ellipse::point_at(e, 0.8 * static_cast<double>(number));
    canvas.text({at.u, at.v}, label.data(), colour, canvas.zoom() > 1 ? 2 : 1);
  }
}

}  // namespace pharos::tools
