// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Rows of `pharos reproduce stations` from the logs of a folder. Throws host::InputError.
std::vector<ComparisonRow> reproduce_stations(const std::string& folder);

}  // namespace pharos::tools
