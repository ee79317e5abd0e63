// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// The parts `slam-good` and `slam-low` of the report. Quick: own rays, the shortest turn.
std::vector<report::Part> slam_parts();

}  // namespace pharos::tools
