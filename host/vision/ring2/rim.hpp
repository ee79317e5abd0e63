// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// Rims of which one edge was seen, perhaps the inner one.
enum OneEdge : std::uint8_t { kOneEdgeRing = 1, kOneEdgeNozzle = 2 };

/// Looks for the rims' other edges: rims of rings and nozzles are faces between two circles, and where light leaves the
/// outer one without contrast in one image, the circle that both images share is the inner one.
///
/// `contours`: all that each image has. An ellipse that is a wider circle in the plane and about the centre of ring or
/// nozzle becomes its radius, with its covariance. Where a rim shows neither a wider nor a narrower edge, the radius'
/// variance grows by that of a rim's width; returns OneEdge bits of these.
std::uint8_t settle_rims(const ring2::Rig& rig, const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours,
                         ring2::Ring2Estimate& estimate);

}  // namespace pharos::host
