// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/detect.hpp"

#include "pharos/ellipse/arcs.hpp"
#include "pharos/ellipse/combine.hpp"
#include "pharos/ellipse/contours.hpp"
#include "pharos/ellipse/edges.hpp"
#include "pharos/ellipse/gradient.hpp"
#include "pharos/ellipse/smooth.hpp"

namespace pharos::ellipse {

void trace_contours(ImageView<const std::uint16_t> image, EllipseWorkspace& workspace, Contours& contours) {
  workspace.counters = {};
  workspace.width_px = image.width_px;
  workspace.height_px = image.height_px;
  workspace.edges.clear();
  workspace.ordered.clear();
  workspace.arcs.clear();
  workspace.found.clear();
  contours.clear();
  const std::size_t pixels = image.pixels();
  if (image.width_px < kMinSide_px || image.height_px < kMinSide_px || image.width_px > kMaxSide_px ||
      image.height_px > kMaxSide_px || kPlanes * pixels > workspace.planes.size()) {
    return;
  }
  const auto plane = [&](std::size_t k) {
    return ImageView<std::uint16_t>(workspace.planes.data() + k * pixels, image.width_px, image.height_px);
  };
  const ImageView<std::uint16_t> smoothed = plane(0), magnitude = plane(1), places = plane(2);
  smooth(image, magnitude, smoothed);
  gradient_magnitude(smoothed, magnitude);
  const EdgeThresholds thresholds = adaptive_thresholds(magnitude, kMaxEdgePoints);
  workspace.noise = thresholds.noise;
  find_edges(smoothed, magnitude, thresholds.low, places, workspace);
  follow_contours(magnitude, thresholds.high, places, workspace, contours);
}

std::span<const DetectedEllipse> ellipses_along(const Contours& contours, const EllipseSettings& settings,
                                                EllipseWorkspace& workspace) {
  find_arcs(contours, workspace);
  combine_arcs(settings, workspace);
  return {workspace.found.data(), workspace.found.size()};
}

std::span<const DetectedEllipse> detect_ellipses(ImageView<const std::uint16_t> image, const EllipseSettings& settings,
                                                 EllipseWorkspace& workspace) {
  Contours contours;
  trace_contours(image, workspace, contours);
  return ellipses_along(contours, settings, workspace);
}

}  // namespace pharos::ellipse
