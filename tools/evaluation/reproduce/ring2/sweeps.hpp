// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Figures 8 to 10 of paper 001, without noise: largest errors of its method, of its monocular variant and of the exact
/// solution.
std::vector<ComparisonRow> reproduce_ring2_sweeps(std::uint64_t seed);

/// What the paper leaves out: `problems` random attitudes with noisy edges.
std::vector<ComparisonRow> reproduce_ring2_noise(int problems, std::uint64_t seed);

}  // namespace pharos::tools
