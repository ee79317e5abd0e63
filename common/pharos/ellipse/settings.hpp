// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::ellipse {

/// What is looked for. The defaults are for docking rings seen by a camera of 640x480; the README says what each rests
/// on.
struct EllipseSettings {
  /// Least semi-minor axis.
  double min_minor_px = 4.0;
  /// T1 of (2): a/b above it scores 0. The paper's 2 refuses circles tilted by more than 60 deg.
  double max_axis_ratio = 4.0;
  /// T_val: F_val below it is no ellipse.
  double min_score = 0.68;
  /// Edges that lie less closely on the contour are no ellipse's: a polygon's.
  double max_rms_px = 0.4;
  /// An arc or a pair of arcs proposes an ellipse from so many edge points on; 0: as they come. For large ellipses
  /// among foil, whose hundreds of short arcs make thousands of pairs.
  std::uint32_t min_proposal_points = 0;
};

}  // namespace pharos::ellipse
