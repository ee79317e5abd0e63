// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/ring2/contour.hpp"
#include "pharos/ring2/rig.hpp"

namespace pharos::host {

/// A circle in the rig's frame whose image is looked for.
struct ExpectedCircle {
  Vector3 centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();
  double radius_m = 0.0;
};

/// How far from an expected contour edges are looked for, and how far off they may be to count fully.
struct EdgeSearch {
  double reach_px = 6.0;
  double scale_px = 2.5;  ///< of the robust weight 1 / (1 + (offset / scale)^2)^2
};

/// Places of steepest change on one grey profile across a contour, outwards.
struct EdgePeaks {
  std::array<double, 16> offset_px{};
  std::array<double, 16> slope{};
  std::size_t count = 0;
};

/// The edges that an image has about an expected contour, profile by profile. `max_width`: of other circles in its
/// plane about its centre, as a fraction of the radius.
struct ContourPeaks {
  EdgePeaks peaks;
  /// Where the circle's image would be along the profile if its radius were wider by w: w slope_px + w^2 bend_px.
  double slope_px = 0.0, bend_px = 0.0;
};
std::vector<ContourPeaks> contour_peaks(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, double reach_px, double max_width);

/// What an image has along an expected contour.
struct EdgeContour {
  /// The ellipse through its edges, with their information; where it has no edges, as expected and without information.
  ring2::Contour contour;
  double seen = 0.0;      ///< of the contour within the image, the fraction that has an edge where the ellipse runs
  double evidence = 0.0;  ///< log of the likelihood ratio: these edges are the circle's, or chance
  double evidence_limit = 0.0;  ///< what it would be if every place had its edge
  int edges = 0;                ///< places that have an edge where the ellipse runs
};

/// Measures an expected circle's contour anew: grey profiles across it, the places of steepest change on them, and a
/// least-distance ellipse through these, weighted by their distance from the expected contour. Edges of anything else
/// have little weight, so that a contour half of which is hidden stays itself. `systematic_px`: of an edge, not reduced
/// by more points. Empty where the circle is behind the camera or out of the image.
std::optional<EdgeContour> edge_contour(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, const EdgeSearch& search, double systematic_px);

}  // namespace pharos::host
