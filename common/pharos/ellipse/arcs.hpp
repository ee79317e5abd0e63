// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/ellipse/contours.hpp"
#include "pharos/ellipse/workspace.hpp"

namespace pharos::ellipse {

/// Cuts contours into arcs at their turning points and keeps those that are long and curved enough.
///
/// The polygon A0 A1 ... of paper 000, 2.2.1 (1) is the contour's Douglas-Peucker approximation, whose sides grow with
/// the radius: the bend at each vertex exceeds the points' noise. A vertex is a turning point where the bend theta_i
/// exceeds T_theta, or where the bend's sign changes: | |theta_i| - |theta_(i-1)| | < |theta_i - theta_(i-1)|. Fills
/// workspace.arcs, the longest kMaxArcs of them when there are more.
void find_arcs(const Contours& contours, EllipseWorkspace& workspace);

/// Whether the bend changes its sign between two vertices (the paper's inequality; false where either is 0).
inline bool bend_changes(float theta_before, float theta) {
  const auto magnitude = [](float x) { return x < 0.0F ? -x : x; };
  return magnitude(magnitude(theta) - magnitude(theta_before)) < magnitude(theta - theta_before);
}

}  // namespace pharos::ellipse
