// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "host/vision/ring2/ring_hypothesis.hpp"

namespace pharos::host {

/// A known length.
struct KnownLength {
  double value_m = 0.0;
  double sigma_m = 0.0;
};

/// Known sizes of the target; sizes that are not given are estimated.
struct RingSizes {
  std::optional<KnownLength> outer_radius, inner_radius, exit_radius, distance;
};

/// A hypothesis that was refined on the images' edges, and its estimate.
struct FollowedHypothesis {
  RingHypothesis hypothesis;
  ring2::Ring2Estimate estimate;
  double rim_evidence = 0.0;  ///< log-likelihood ratio for a face between two edges
};

/// The chosen hypothesis, and the most likely one with another answer if the two cannot be distinguished.
struct RingDecision {
  const FollowedHypothesis* best = nullptr;  ///< null: no hypothesis is a ring
  const FollowedHypothesis* rival = nullptr;
  double delta_chi2 = 0.0;  ///< twice their log-likelihood ratio
};

/// The most likely hypothesis. It must have a ring with a face and a nozzle whose edges are beyond chance, or a ring of
/// the known size. Hypotheses of the same edges are compared by their evidence. Circles elsewhere that could also be
/// ring and nozzle are as likely, unless known sizes exclude them.
RingDecision decide(const ring2::Rig& rig, std::span<const FollowedHypothesis> followed, const RingSizes& sizes);

/// Whether a hypothesis without a nozzle, followed on the edges, is a ring with a face of its own beside another ring:
/// either may be the docking ring. Circles about that one's axis, and far smaller ones, are not.
bool is_ring_beside(const FollowedHypothesis& other, const FollowedHypothesis& ring);
/// Whether it may be, by its circle alone.
bool may_be_ring_beside(const ring2::CircleModel& other, const ring2::CircleModel& ring);

}  // namespace pharos::host
