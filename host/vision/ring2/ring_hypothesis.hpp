// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/vision/ring2/circle_match.hpp"
#include "host/vision/ring2/edge_contour.hpp"

namespace pharos::host {

using Ring2Images = std::array<ImageView<const std::uint16_t>, ring2::kViews>;

/// Minimum distance of a nozzle's exit in front of its ring, in radii of the ring, more than the width of a rim:
/// throat, grooves, and a ring before the edge of a round body are no nozzle.
inline constexpr double kMinNozzleDistance = 0.08;

/// An assignment of circles in a pair of images to ring and nozzle.
struct RingHypothesis {
  ring2::ContourSet contours;
  /// The same contours with less information where they are disturbed: what decides which hypothesis is the ring.
  ring2::ContourSet cautious;
  /// The same with what their errors are: what the answer states.
  ring2::ContourSet stated;
  ring2::CircleModel model;  ///< both circles; the second radius is 0 if there is no nozzle
  bool has_nozzle = false;
  double evidence = 0.0;         ///< log-likelihood ratio of all contours against chance
  double nozzle_evidence = 0.0;  ///< that of the nozzle's contours only
  /// Evidence of ring and nozzle if nothing hid or disturbed their edges.
  std::array<double, ring2::kFeatures> evidence_limit{};
  int edges = 0;                                                           ///< edge points of all contours
  std::array<std::array<double, ring2::kFeatures>, ring2::kViews> seen{};  ///< visible fraction of each contour
};

/// Every combination of ring and nozzle that the ellipses of both images allow, best fit first. Ellipses may have
/// errors of some pixels, if edge points of shadows and of objects in front of a rim were included.
std::vector<RingHypothesis> ring_hypotheses(const ring2::Rig& rig,
                                            const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours);

/// The same from three ellipses: one view has no ellipse of the ring, or none of the nozzle.
std::vector<RingHypothesis> three_ellipse_hypotheses(
    const ring2::Rig& rig, const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours);

/// Refines a hypothesis on the edges of both images. In each round contours are measured where the model predicts them,
/// and the model is fitted to all of them; the search range decreases. The first rounds converge, the last ones
/// measure. False if a fit fails.
enum class FollowRounds : std::uint8_t { kFirst, kLast };
bool follow_edges(const ring2::Rig& rig, const Ring2Images& images, double systematic_px, FollowRounds rounds,
                  RingHypothesis& hypothesis);

/// Whether two hypotheses have converged to the same circles.
bool is_same(const RingHypothesis& a, const RingHypothesis& b);

}  // namespace pharos::host
