// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Figures 7 to 10 of paper 001, without noise: errors of its method, of its steps with the left camera alone, of the
/// monocular method of its reference 10, and of the exact solution. With `folder` also the pictures are written there.
report::PartResult reproduce_ring2_sweeps(std::uint64_t seed, const std::filesystem::path& folder = {});

/// What the paper leaves out: `problems` random attitudes with noisy edges.
std::vector<ComparisonRow> reproduce_ring2_noise(int problems, std::uint64_t seed);

/// The part `ring2` of the report.
report::Part ring2_part();

}  // namespace pharos::tools
