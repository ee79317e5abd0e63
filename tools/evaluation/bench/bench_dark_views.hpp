// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// Two views, 5 deg apart, of a satellite lit only by ambient light 0.1 and 0.01: features that match after
/// enhancement and after each of its peers (medians over the pairs), light around the target's rim, and pairs a second.
void add_dark_views(int pairs, std::vector<BenchRow>& rows);

}  // namespace pharos::tools
