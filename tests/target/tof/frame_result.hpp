// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/tof_pose.hpp"

namespace pharos::test {

/// Prints the results of a frame for compare.py: ellipses, ring, connector, pose.
void print_result(const Result<tof::TofPose, tof::TofFailure>& result, const tof::TofWorkspace& workspace);

}  // namespace pharos::test
