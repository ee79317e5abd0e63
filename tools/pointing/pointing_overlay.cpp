// SPDX-License-Identifier: Apache-2.0
#include "tools/pointing/pointing_overlay.hpp"

#include <fmt/format.h>

#include "host/images/canvas.hpp"
#include "host/preview/pointing_drawing.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

using host::Canvas;
namespace colours = host::colours;

}  // namespace

void write_pointing_overlay(const std::string& path, ImageView<const std::uint16_t> image, const PinholeCamera& camera,
                            const pointing::PanelMeasurement& panel, const pointing::PointingResult& answer) {
  Canvas canvas(image, Canvas::zoom_for(image.width_px));
  host::pointing_drawing(panel, camera).draw(canvas);
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
