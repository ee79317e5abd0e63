// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "host/vision/ring2/ring_hypothesis.hpp"

namespace pharos::host {

/// A length that is known beforehand.
struct KnownLength {
  double value_m = 0.0;
  double sigma_m = 0.0;
};

/// What may be told of the target; what is not told is found.
struct RingSizes {
  std::optional<KnownLength> outer_radius, inner_radius, exit_radius, distance;
};

/// A hypothesis whose circles were moved to the images' edges, and what the estimator makes of them.
struct FollowedHypothesis {
  RingHypothesis hypothesis;
  ring2::Ring2Estimate estimate;
  double rim_evidence = 0.0;  ///< that its ring has a face between two edges
};

/// Which of them the pair's answer is; and the best other one, where it cannot be told from it.
struct RingDecision {
  const FollowedHypothesis* best = nullptr;  ///< none: no hypothesis is a ring
  const FollowedHypothesis* rival = nullptr;
  double delta_chi2 = 0.0;  ///< twice the logarithm of their likelihoods' ratio
};

/// The most likely hypothesis. One must have a ring, with a face, and a nozzle that the images show beyond chance, or a
/// ring of the size that is told. Other hypotheses of the same edges compete by their evidence; circles elsewhere that
/// could be ring and nozzle as well are no less likely, unless sizes tell.
RingDecision decide(const ring2::Rig& rig, std::span<const FollowedHypothesis> followed, const RingSizes& sizes);

}  // namespace pharos::host
