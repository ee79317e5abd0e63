// SPDX-License-Identifier: Apache-2.0
#include "host/preview/pointing_drawing.hpp"

#include <utility>
#include <vector>

namespace pharos::host {
namespace {

// A line of the ideal image as the lens bends it.
void add_ideal(Drawing& drawing, const PinholeCamera& camera, const pointing::Segment& segment, Colour colour) {
  constexpr int kPieces = 32;
  std::vector<Place> places;
  for (int k = 0; k <= kPieces; ++k) {
    const Vector2 at = segment.begin + static_cast<double>(k) / kPieces * (segment.end - segment.begin);
    const Vector2 pixel =
        distort(camera, {(at.x() - camera.cx_px) / camera.fx_px, (at.y() - camera.cy_px) / camera.fy_px});
    places.push_back({pixel.x(), pixel.y()});
  }
  drawing.polyline(std::move(places), colour, 1.5);
}

}  // namespace

Drawing pointing_drawing(const pointing::PanelMeasurement& panel, const PinholeCamera& camera) {
  Drawing drawing;
  for (const pointing::Segment& edge : panel.outline) {
    drawing.polyline({{edge.begin.x(), edge.begin.y()}, {edge.end.x(), edge.end.y()}}, colours::kGrey, 3.0);
  }
  for (const pointing::Segment& edge : panel.short_edges) add_ideal(drawing, camera, edge, colours::kSky);
  for (const pointing::Segment& edge : panel.long_edges) add_ideal(drawing, camera, edge, colours::kGreen);
  return drawing;
}

}  // namespace pharos::host
