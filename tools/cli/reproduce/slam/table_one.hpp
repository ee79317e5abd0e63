// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/cli/reproduce/comparison.hpp"

namespace pharos::tools {

struct TableOneOptions {
  std::vector<double> turns_deg{30.0, 60.0, 90.0, 180.0, 360.0, 720.0};
  int features = 1000;
  bool povray = true;
  std::uint64_t seed = 1;
  std::function<void(std::size_t)> step;  ///< called with the number of pairs done
};

/// Pairs that these options make of all sequences.
std::size_t table_one_pairs(const TableOneOptions& options);

/// Table 1 of paper 004: each turn in good light, and in low light with and without enhancement; from 360 deg on also
/// without loop closing. Rows: attitude RMSE, error of the last attitude, loops closed, frames without a pose.
std::vector<ComparisonRow> reproduce_table_one(const TableOneOptions& options);

}  // namespace pharos::tools
