// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>

#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Half the width of a blurred strip whose edges are seen 2 `seen_px` apart; none below the blur's own sigma.
///
/// The edges at -h and +h, of opposite steps, are steepest at x = +-seen: (x - h) g(x - h) = (x + h) g(x + h) for a
/// Gaussian g of the blur's sigma s, hence h = x tanh(x h / s^2).
struct StripWidth {
  double half_px = 0.0;
  double slope = 1.0;    ///< change of half_px by that of seen_px
  double by_blur = 0.0;  ///< change of half_px by that of the blur's variance, 1/px
};
StripWidth strip_of(double seen_px);

/// Moves the contours of concentric ellipses of opposite polarity, whose edges push each other apart in the blur, back
/// to where they are, and widens their covariance: a ring 3 px wide is seen 0.6 px wider.
/// Returns which of the ellipses were moved.
std::bitset<kMaxEllipses> separate_close_edges(EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
