// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/segment.hpp"
#include "host/vision/pointing/target_mask.hpp"
#include "pharos/pointing/line_fit.hpp"

namespace pharos::pointing {

/// What stands behind an edge.
struct Backdrop {
  double level = 0.0;
  double sigma = 0.0;
};

/// Sub-pixel points of an edge: the position of the rise from sky to target, in every row (or column) that it crosses.
struct MeasuredEdge {
  std::vector<pointing::EdgePoint> points;  ///< in order along the edge, in the distorted image
  Segment extent;                           ///< as far as the edge was followed, corners included
  double blur_px = 0.0;                     ///< sigma of the rise
  double corner_px = 0.0;                   ///< from the extent's ends, within which no point was taken
  double contrast = 0.0;                    ///< of target over sky, the points' median
  /// How far the dark side is brighter than the sky, of the edge's contrast: another face in the dark, not the sky.
  double backing = 0.0;
  /// Mean grey level beyond the rise and what stands within 5 px of it (a panel's own thickness), and its sigma; empty
  /// where the image ends before.
  std::optional<Backdrop> backdrop;
  /// How far what stands beside the edge all along it (cells, a wall, another part) could shift it: the shift that
  /// would change a profile as much as the edge's mean profile differs from a Gaussian rise, px.
  double structure_px = 0.0;
  bool cut = false;  ///< runs into the image's border
};

/// Sub-pixel positions of an edge on the grey image, by a Gaussian's integral fitted to each row's or column's pixels.
///
/// `guess` has the target on its positive side; within `reach_px` across it pixels belong to this edge alone. Points
/// whose dark side is not the sky (another part is there) are left out. The edge is followed beyond the guess' ends to
/// its own; corners are left out. An edge of which too few rows show the rise is measured again by short profiles. No
/// points where that fails, and where there is no edge.
MeasuredEdge measure_edge(ImageView<const std::uint16_t> image, const TargetMask& target, const Segment& guess,
                          double reach_px);

}  // namespace pharos::pointing
