// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Paper 003's tables 1 and 2: its four attitudes, rendered 100 m before a telescope of 6000 px focal length, measured
/// as `pharos line` does.
///
/// Table 1's station columns are what is rendered, so what is compared is whether they come back. Its Earth-fixed
/// columns cannot be had from them by any rotation; ours are WGS-84's for the paper's station. Table 2: the angle
/// between long and short side.
std::vector<ComparisonRow> reproduce_attitudes(std::uint64_t seed);

}  // namespace pharos::tools
