// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::slam {

/// Neighbouring points as groups of at least `minimum` and at most twice as many: halved at the median of their longest
/// extent until a half would be smaller. Returns each point's group, from 0. Fewer points than `minimum` are one group.
std::vector<std::size_t> point_groups(const std::vector<Vector3>& points, std::size_t minimum);

}  // namespace pharos::slam
