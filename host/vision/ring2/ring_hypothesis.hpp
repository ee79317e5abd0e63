// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/vision/ring2/circle_match.hpp"
#include "host/vision/ring2/edge_contour.hpp"

namespace pharos::host {

using Ring2Images = std::array<ImageView<const std::uint16_t>, ring2::kViews>;

/// One way to name circles of a pair: this is the ring, that its nozzle.
struct RingHypothesis {
  ring2::ContourSet contours;
  ring2::CircleModel model;  ///< both circles; the second one's radius is 0 where there is no nozzle
  bool has_nozzle = false;
  double evidence = 0.0;         ///< of all contours together: log-likelihood ratio against chance
  double nozzle_evidence = 0.0;  ///< of the nozzle's alone
  /// What ring's and nozzle's evidence would be if nothing hid or disturbed their edges.
  std::array<double, ring2::kFeatures> evidence_limit{};
  int edges = 0;                                                           ///< edge points of all contours
  std::array<std::array<double, ring2::kFeatures>, ring2::kViews> seen{};  ///< fraction of each contour
};

/// Every ring with every nozzle that ellipses of both images allow, those that fit best first. Ellipses may be some
/// pixels off: shadows and what stands before a rim lend them points.
std::vector<RingHypothesis> ring_hypotheses(const ring2::Rig& rig,
                                            const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours);

/// The same where one view has no ellipse of the ring, or none of the nozzle: three ellipses.
std::vector<RingHypothesis> three_ellipse_hypotheses(
    const ring2::Rig& rig, const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours);

/// Moves a hypothesis' circles to the images' edges, all views together: contours are measured about where the model
/// puts them, the model is fitted to all of them, in rounds of smaller and smaller reach: the first ones bring it
/// there, the last ones measure. False where it does not hold together.
enum class FollowRounds : std::uint8_t { kFirst, kLast };
bool follow_edges(const ring2::Rig& rig, const Ring2Images& images, double systematic_px, FollowRounds rounds,
                  RingHypothesis& hypothesis);

/// Whether two hypotheses have come to the same circles.
bool is_same(const RingHypothesis& a, const RingHypothesis& b);

}  // namespace pharos::host
