// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

struct StaticSetsOptions {
  int sets = 50;        // as the paper
  double set_s = 60.0;  // 3600 frames at 60 Hz, as the paper
  std::uint64_t seed = 1;
  std::string sets_file;  // one row a set; empty: none
};

/// Paper 002, section 4.2 and figure 5: sets of a stationary target, their spread as predicted by (24) and measured by
/// (23), by the paper's method (paper_pose.hpp) and ours. Poses as in the paper: anywhere on a 3 m x 3 m floor ahead,
/// any attitude in which at least four sensors are visible. With `folder` also the picture of figure 5 is written
/// there.
report::PartResult reproduce_static_sets(const StaticSetsOptions& options, const std::filesystem::path& folder = {});

}  // namespace pharos::tools
