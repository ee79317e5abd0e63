// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/reproduce/stations/residual_map.hpp"

namespace pharos::tools {

/// Of `pharos reproduce stations`: its rows, and what each plane of the stations leaves.
struct StationTable {
  std::vector<ComparisonRow> rows;
  std::vector<ResidualCell> residuals;
};

/// From the logs of a folder. Throws host::InputError.
StationTable reproduce_stations(const std::string& folder);

}  // namespace pharos::tools
