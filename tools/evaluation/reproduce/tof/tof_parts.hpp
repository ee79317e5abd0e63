// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// The parts `tof-boards` and `tof-tests` of the report.
std::vector<report::Part> tof_parts();

}  // namespace pharos::tools
