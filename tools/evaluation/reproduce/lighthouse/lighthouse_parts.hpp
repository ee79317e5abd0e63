// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/report/part.hpp"
#include "tools/evaluation/reproduce/lighthouse/dynamic_runs.hpp"
#include "tools/evaluation/reproduce/lighthouse/static_sets.hpp"

namespace pharos::tools {

/// `--quick`: fewer and shorter sets and runs.
void make_quick(StaticSetsOptions& sets);
void make_quick(DynamicRunsOptions& runs);

/// The parts `lighthouse-sets` and `lighthouse-flights` of the report.
std::vector<report::Part> lighthouse_parts();

}  // namespace pharos::tools
