// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// An experiment: what the region is that the paper's chain takes for the nearest connector, and why gamma jumps.
///
/// Tests 1 and 3 (4.2 and 3.2 m), `frames` of each, at the simulated depth noise and less of it. Each chosen region is
/// laid on the true connectors. A control keeps only regions on the true nearest connector and leaves all other steps.
std::vector<ComparisonRow> reproduce_connector_choice(int frames, std::uint64_t seed, bool printed_threshold);

}  // namespace pharos::tools
