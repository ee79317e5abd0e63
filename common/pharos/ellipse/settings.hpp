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
  /// Arcs of fewer edge points propose no ellipse; they support those that others propose. Of large ellipses among
  /// foil, whose many short arcs cost the more the more pairs they make.
  std::uint32_t min_seed_points = 12;
};

}  // namespace pharos::ellipse
