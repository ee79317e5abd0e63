// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::ellipse {

/// Settings of the detection. The defaults are for docking rings seen by a camera of 640x480; the README gives their
/// reasons.
struct EllipseSettings {
  /// Minimum semi-minor axis.
  double min_minor_px = 2.0;
  /// T1 of (2): a/b above it scores 0. The paper's 2 refuses circles tilted by more than 60 deg.
  double max_axis_ratio = 4.0;
  /// T_val: an ellipse with F_val below it is dropped.
  double min_score = 0.68;
  /// Maximum distance of edges from the contour; larger ones are a polygon's.
  double max_rms_px = 0.4;
  /// Minimum edge points of an arc or a pair of arcs that proposes an ellipse; 0: no limit. For large ellipses among
  /// foil, whose hundreds of short arcs make thousands of pairs.
  std::uint32_t min_proposal_points = 0;
};

}  // namespace pharos::ellipse
