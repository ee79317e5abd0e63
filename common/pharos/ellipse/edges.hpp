// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/gradient.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Canny's thin edges, to a fraction of a pixel: pixels above `low` whose magnitude is the greatest along their
/// gradient, moved to the top of the parabola through the three values there (Devernay 1995).
///
/// Fills workspace.edges row by row and `places`: 1 + index of the edge point found at each pixel, 0 where none.
void find_edges(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::uint16_t low,
                ImageView<std::uint16_t> places, EllipseWorkspace& workspace);

}  // namespace pharos::ellipse
