// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

struct StaticSetsOptions {
  int sets = 50;        // as the paper
  double set_s = 60.0;  // 3600 frames at 60 Hz, as the paper
  std::uint64_t seed = 1;
  std::string sets_file;  // one row a set; empty: none
};

/// Paper 002, section 4.2 and figure 5: sets of a target at rest, what (24) predicts of their spread and what (23)
/// measures. The target stands as the paper's did: anywhere on a 3 m x 3 m floor ahead, any attitude that shows at
/// least four sensors.
std::vector<ComparisonRow> reproduce_static_sets(const StaticSetsOptions& options);

}  // namespace pharos::tools
