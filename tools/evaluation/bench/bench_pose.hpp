// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// Pose solving on the target class of the published figures (frustum of twelve sensors, 4-8 of them seen, 1-5 m,
/// +-60 deg, 8.8 arcsec): time a solve and accuracy, ours and the peers' on the same problems in turn. A time is the
/// median over the problems of the minimum of several repeats, which depends little on other load of the machine.
std::vector<BenchRow> bench_pose(int problems);

}  // namespace pharos::tools
