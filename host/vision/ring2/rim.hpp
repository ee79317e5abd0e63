// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// Rims of which only one edge was seen, possibly the inner one.
enum OneEdge : std::uint8_t { kOneEdgeRing = 1, kOneEdgeNozzle = 2 };

/// Searches the rims' other edges: rims of rings and nozzles are faces between two circles, and where the outer one has
/// no contrast in one image, the circle common to both images is the inner one.
///
/// `contours`: all of each image. An ellipse that is a wider concentric circle in the plane of ring or nozzle gives its
/// radius, with its covariance. Where a rim shows neither a wider nor a narrower edge, the radius' variance grows by
/// that of a rim's width; returns OneEdge bits of these.
std::uint8_t settle_rims(const ring2::Rig& rig, const std::array<std::vector<ring2::Contour>, ring2::kViews>& contours,
                         ring2::Ring2Estimate& estimate);

}  // namespace pharos::host
