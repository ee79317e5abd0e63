// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Pairs of edges by length, slope, end points and mutual convergence.
std::vector<EdgePair> facing_pairs(const std::vector<Segment>& edges, const TargetMask& target);

/// The largest ratio of the separations of a wing's two panels in the image.
inline constexpr double kWingWidths = 1.7;

/// Whether two pairs stand in one line in the image with a gap between them, as a wing's panels do.
bool is_wing(const EdgePair& a, const EdgePair& b);

/// Whether a longer and wider pair stands beyond `own` in the line of the wing that it makes with `other`: that is the
/// panel, and `own` the yoke that holds it.
bool is_yoke(const EdgePair& own, const EdgePair& other, const EdgePair& pair);

}  // namespace pharos::pointing
