// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pharos/pointing/line_fit.hpp"

namespace pharos::pointing {

/// Leaves the points of one edge where two in line, a panel's and a body's beyond it, were followed as one.
///
/// Pieces on either side of a gap that is wider than kEdgeGap_px belong together if the fit of the longest says so
/// within its uncertainty, and within what stands beside it (`structure_px`, MeasuredEdge) shifts it. Where one is left
/// out, so is what is within `corner_px` of that end: a corner. `points`: in order along the edge. True where something
/// was left out.
bool keep_one_edge(std::vector<EdgePoint>& points, double structure_px, double corner_px);

/// Leaves the longer part of an edge that has a step: where something else begins behind it, grey values that are no
/// multiple of the light move it otherwise, or another edge begins there, too near for a gap. `points`: in order, in
/// the ideal image, where a straight edge is straight. True where something was left out.
bool keep_one_part(std::vector<EdgePoint>& points);

/// Points are one to 1.4 px apart; noise or a star interrupts an edge for less.
inline constexpr double kEdgeGap_px = 5.0;

}  // namespace pharos::pointing
