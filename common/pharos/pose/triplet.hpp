// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/pose/observation_table.hpp"

namespace pharos::pose {

using Triplet = std::array<int, 3>;

/// Three sensors of the set whose triangle, as the station sees it, is large: the farthest from the mean ray, the
/// farthest from that, and the one that spans the largest triangle with both. O(n); within a few percent of the best
/// triangle for compact targets. Needs three rays.
Triplet wide_triplet(const RaySet& set);

/// Squared double area of the triangle of three rays: zero where the line of sight lies in the sensors' plane.
double spread_of(const RaySet& set, const Triplet& triplet);

}  // namespace pharos::pose
