// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"
#include "pharos/pointing/line_fit.hpp"

namespace pharos::pointing {

/// An edge seen closely: where grey rises from sky to target, in every row (or column) that it crosses.
struct MeasuredEdge {
  std::vector<pointing::EdgePoint> points;  ///< in order along the edge, in the image as it was taken
  Segment extent;                           ///< as far as the edge was followed, corners included
  double blur_px = 0.0;                     ///< sigma of the rise
  bool cut = false;                         ///< runs into the image's border
};

/// Sub-pixel places of an edge on the grey image, by a Gaussian's integral fitted to each row's or column's pixels.
///
/// `guess` runs with the target on its positive side; `reach_px` is how far across it pixels belong to this edge alone.
/// Points whose dark side is not the sky (something stands before it) are left out. The edge is followed beyond the
/// guess' ends as far as it goes; corners are left out. Empty points where no edge is there.
MeasuredEdge measure_edge(ImageView<const std::uint16_t> image, const TargetMask& target, const Segment& guess,
                          double reach_px);

}  // namespace pharos::pointing
