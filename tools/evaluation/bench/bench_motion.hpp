// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// Cost of a motion-aware step, microseconds a hit on one core, everything included (flash smoothing, station model,
/// checks by cycles solved alone): twenty simulated seconds of the paper's manoeuvre with one calibrated station; and
/// with two, each station's own track and the joint hypothesis.
std::vector<BenchRow> bench_motion();

}  // namespace pharos::tools
