// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/ellipse/detected_ellipse.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Half the width of a strip, px, whose edges a blur of that variance shows 2 `seen_px` apart; 0 where they are no
/// farther apart than such a blur shows any strip's.
double half_width_of_strip(double seen_px, double variance_px2);

/// By how much the semi-axes of both edges of a narrow ring are off as the picture's blur is not the assumed one
/// (kFlankVariance_px2), px: at the ends of the major axis, and of the minor one.
///
/// A camera out of focus or in motion widens a strip, and its edges do not tell: only the product of width and contrast
/// is seen. But beyond them, away from the strip, the slope falls as the blur does, whatever is between: 2 px farther
/// to some fraction of what it is at the edge. That fraction and what is seen between the edges give the variance, as
/// an average over the quarters of both contours about either axis.
///
/// Outer and inner contour as they are seen, of opposite polarity; 0 where the workspace has no image.
std::array<double, 2> strip_errors(const DetectedEllipse& outer, const DetectedEllipse& inner,
                                   const EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
