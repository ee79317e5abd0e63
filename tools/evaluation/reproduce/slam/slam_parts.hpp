// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// The parts of paper 004: `slam-RUN` for each of table_one_runs(), and `slam-enhance`. Quick: own rays, the shortest
/// turn. Runs in one light share rendered images, which are kept beside the parts (`frames-good`, `frames-low`, some
/// 400 MB each when whole): an interrupted run does not render them again.
std::vector<report::Part> slam_parts();

}  // namespace pharos::tools
