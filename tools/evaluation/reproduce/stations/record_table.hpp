// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools {

/// Rows of the records of libsurvive in a folder (NAME.rec.gz with its configuration NAME.rec.gz.json) that hold
/// another tracker's poses: of each device the poses' agreement with those, and of each plane of its stations the noise
/// of a hit at rest and what the pose leaves. Empty where the folder holds none.
std::vector<ComparisonRow> reproduce_records(const std::string& folder);

}  // namespace pharos::tools
