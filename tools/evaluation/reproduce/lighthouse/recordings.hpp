// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Figures of the real recordings in `directory` (NAME.edges.csv.gz, NAME.target.csv): OOTX counts, time to lock, noise
/// of stationary sensors, rigid-body residuals. Throws InputError when a recording is missing.
std::vector<ComparisonRow> measure_recordings(const std::string& directory);

}  // namespace pharos::tools
