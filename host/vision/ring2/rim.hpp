// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// Rims of which only one edge was detected, possibly the inner one.
enum OneEdge : std::uint8_t { kOneEdgeRing = 1, kOneEdgeNozzle = 2 };

/// Searches the rims' other edges: the rims of rings and nozzles are faces between two circles. If the outer one has no
/// contrast in one image, the circle that both images have in common is the inner one.
///
/// `contours`: all contours of each image. An ellipse that is a wider concentric circle in the plane of ring or nozzle
/// replaces the radius and its covariance. For a rim with neither a wider nor a narrower edge, the radius' variance is
/// increased by that of a rim's width; returns the OneEdge bits of these rims.
std::uint8_t settle_rims(const ring2::Rig& rig, const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours,
                         ring2::Ring2Estimate& estimate);

}  // namespace pharos::host
