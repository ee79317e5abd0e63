// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"

namespace pharos::pointing {

/// Two facing edges with target between them: the long sides of a panel, or any other pair.
struct EdgePair {
  Segment first, second;    ///< first has the pair's direction, second the opposite
  Segment middle;           ///< the line between them, where they overlap
  double separation = 0.0;  ///< px
};

/// One panel, or the two of a wing.
struct PanelChoice {
  std::vector<EdgePair> panels;
};

/// Pairs of edges by length, slope, end points and mutual convergence.
std::vector<EdgePair> facing_pairs(const std::vector<Segment>& edges, const TargetMask& target);

/// The panel's long sides among an outline's edges: two pairs in one line (both panels of a wing) are preferred to one,
/// longer to shorter; body, truss and stars give shorter pairs or none. Empty where there is none.
std::optional<PanelChoice> choose_panels(const std::vector<Segment>& edges, const TargetMask& target);

}  // namespace pharos::pointing
