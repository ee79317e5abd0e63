// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// Cost of a pose in the fusion with five sources and solution separation, microseconds on one core: of one in order
/// (mean and 99 %) and of a late one (mean and 99 %), which starts again from a copy of the state. Thirty simulated
/// seconds two metres from docking; each time is the least of nine runs over the same poses.
std::vector<BenchRow> bench_fusion();

}  // namespace pharos::tools
