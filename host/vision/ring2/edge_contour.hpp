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

/// A circle in the rig's frame whose image is searched for.
struct ExpectedCircle {
  Vector3 centre_m = Vector3::Zero();
  Vector3 normal = -Vector3::UnitZ();
  double radius_m = 0.0;
};

/// Search range on both sides of an expected contour, and the scale of the weight by distance from it.
struct EdgeSearch {
  double reach_px = 6.0;
  double scale_px = 2.5;  ///< of the robust weight 1 / (1 + (offset / scale)^2)^2
};

/// Positions of steepest change in one grey profile across a contour, outwards.
struct EdgePeaks {
  std::array<double, 16> offset_px{};
  std::array<double, 16> slope{};
  std::size_t count = 0;
};

/// The edges of an image near an expected contour, profile by profile. `max_width`: largest difference in radius of
/// concentric circles in its plane, as a fraction of the radius.
struct ContourPeaks {
  EdgePeaks peaks;
  /// Position along the profile of the image of a circle whose radius is larger by the fraction w:
  /// w slope_px + w^2 bend_px.
  double slope_px = 0.0, bend_px = 0.0;
};
std::vector<ContourPeaks> contour_peaks(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, double reach_px, double max_width);

/// Measurement of an expected contour in an image.
struct EdgeContour {
  /// The ellipse fitted to the edges, with their information; without edges, the expected ellipse with no information.
  ring2::Contour contour;
  /// What its errors are, against the weight that its edges get by `contour.information`: an undisturbed contour is far
  /// better than that, and one of which half is disturbed is not.
  ring2::Matrix5 stated_information = ring2::Matrix5::Zero();
  double seen = 0.0;            ///< fraction of the contour within the image that has an edge at the ellipse
  double evidence = 0.0;        ///< log-likelihood ratio of the edges: circle against chance
  double evidence_limit = 0.0;  ///< its value if every profile had its edge
  int edges = 0;                ///< profiles that have an edge at the ellipse
};

/// Measures an expected circle's contour in the image: grey profiles across it, their positions of steepest change, and
/// a least-distance ellipse through these, weighted by their distance from the expected contour. Edges of other objects
/// have little weight, so that a half-hidden contour is still measured correctly. `systematic_px`: error of an edge
/// that more points do not reduce. Empty if the circle is behind the camera or outside the image.
std::optional<EdgeContour> edge_contour(const ring2::RigView& view, ImageView<const std::uint16_t> image,
                                        const ExpectedCircle& circle, const EdgeSearch& search, double systematic_px);

}  // namespace pharos::host
