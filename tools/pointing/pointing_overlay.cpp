// SPDX-License-Identifier: Apache-2.0
#include "tools/pointing/pointing_overlay.hpp"

#include <fmt/format.h>

#include <vector>

#include "host/images/canvas.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

using host::Canvas;
using host::Place;
namespace colours = host::colours;

// A line of the ideal image as the lens bends it.
void draw_ideal(Canvas& canvas, const PinholeCamera& camera, const pointing::Segment& segment, host::Colour colour) {
  constexpr int kPieces = 32;
  std::vector<Place> places;
  for (int k = 0; k <= kPieces; ++k) {
    const Vector2 at = segment.begin + static_cast<double>(k) / kPieces * (segment.end - segment.begin);
    const Vector2 pixel =
        distort(camera, {(at.x() - camera.cx_px) / camera.fx_px, (at.y() - camera.cy_px) / camera.fy_px});
    places.push_back({pixel.x(), pixel.y()});
  }
  canvas.polyline(places, colour, 1.5);
}

}  // namespace

void write_pointing_overlay(const std::string& path, ImageView<const std::uint16_t> image, const PinholeCamera& camera,
                            const pointing::PanelMeasurement& panel, const pointing::PointingResult& answer) {
  Canvas canvas(image, Canvas::zoom_for(image.width_px));
  for (const pointing::Segment& edge : panel.outline) {
    canvas.line({edge.begin.x(), edge.begin.y()}, {edge.end.x(), edge.end.y()}, colours::kGrey, 3.0);
  }
  for (const pointing::Segment& edge : panel.short_edges) draw_ideal(canvas, camera, edge, colours::kSky);
  for (const pointing::Segment& edge : panel.long_edges) draw_ideal(canvas, camera, edge, colours::kGreen);
  const pointing::PitchYaw angles = pointing::pitch_yaw(answer.axis.axis);
  const double line_px = 20.0 / canvas.zoom();
  canvas.text({line_px, line_px},
              fmt::format("pitch {:.3f} deg  yaw {:.3f} deg  sigma {:.3g} deg", angles.pitch_rad * kDegPerRad,
                          angles.yaw_rad * kDegPerRad, answer.axis.sigma_rad() * kDegPerRad),
              colours::kWhite);
  canvas.text({line_px, 2.2 * line_px},
              fmt::format("plane sigma {:.3g} deg  {}", answer.axis.sigma_plane_rad * kDegPerRad,
                          host::joined_flags(answer.flags, pointing::kPointingFlagWords)),
              colours::kWhite);
  canvas.write_png(path);
}

void write_pointing_overlay(const std::string& path, ImageView<const std::uint16_t> image, const std::string& status) {
  Canvas canvas(image, Canvas::zoom_for(image.width_px));
  const double line_px = 20.0 / canvas.zoom();
  canvas.text({line_px, line_px}, status, colours::kRed);
  canvas.write_png(path);
}

}  // namespace pharos::tools
