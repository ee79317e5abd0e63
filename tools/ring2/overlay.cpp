// SPDX-License-Identifier: Apache-2.0
#include "tools/ring2/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/images/canvas.hpp"
#include "host/preview/ring2_drawing.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

namespace colours = host::colours;

// Both images in one, the right one beside the left.
host::GreyImage side_by_side(const std::array<host::GreyImage, 2>& images) {
  host::GreyImage joined;
  joined.width_px = images[0].width_px + images[1].width_px;
  joined.height_px = std::max(images[0].height_px, images[1].height_px);
  joined.pixels.resize(static_cast<std::size_t>(joined.width_px) * static_cast<std::size_t>(joined.height_px));
  std::int32_t begin = 0;
  for (const host::GreyImage& image : images) {
    for (std::int32_t v = 0; v < image.height_px; ++v) {
      std::copy_n(image.view().row(v), image.width_px, joined.view().row(v) + begin);
    }
    begin += image.width_px;
  }
  return joined;
}

std::string words_of(const host::Ring2Detection& circles) {
  if (!circles.estimate) return "refused_" + circles.refusal;
  const ring2::Attitude attitude = ring2::attitude_of(circles.estimate->normal);
  return fmt::format("theta {:.3f} gamma {:.3f} deg, sigma {:.3f} deg{}", attitude.theta_rad * kDegPerRad,
                     attitude.gamma_rad * kDegPerRad, circles.estimate->sigma_normal_rad() * kDegPerRad,
                     circles.estimate->ambiguous() ? ", ambiguous" : "");
}

}  // namespace

void write_ring2_overlay(const std::string& path, const std::array<host::GreyImage, 2>& images, const ring2::Rig& rig,
                         const host::Ring2Detection& circles) {
  const host::GreyImage joined = side_by_side(images);
  host::Canvas canvas(joined.view(), host::Canvas::zoom_for(joined.width_px));
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    const double shift_px = v == 0 ? 0.0 : images[0].width_px;
    host::ring2_drawing(circles, rig, v).draw(canvas, {1, shift_px});
  }
  canvas.text({4.0, 4.0}, words_of(circles), circles.estimate ? colours::kWhite : colours::kOrange);
  canvas.write_png(path);
}

}  // namespace pharos::tools
