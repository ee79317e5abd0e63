// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/ellipse/gradient.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Maximum contours stored of one image; more are counted as dropped.
inline constexpr std::size_t kMaxContours = 2048;

/// Edge points of one connected line: [begin, end) of a list of edge points.
struct Contour {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};
using Contours = StaticVector<Contour, kMaxContours>;

/// Follows edge points from those of at least `high` through all their neighbours along the edge (Canny's hysteresis),
/// the brighter side always on the right, then joins contours where one's end and another's start are near and have the
/// same direction.
///
/// Fills workspace.ordered with the points along the contours and returns the contours' ranges. `places` is find_edges'
/// and is overwritten.
void follow_contours(ImageView<const std::uint16_t> magnitude, std::uint16_t high, ImageView<std::uint16_t> places,
                     EllipseWorkspace& workspace, Contours& contours);

}  // namespace pharos::ellipse
