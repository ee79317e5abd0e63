// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/tof/tof_pose.hpp"

namespace pharos::tools {

/// A picture of what was found in a frame, for people: edges of arcs (grey), ellipses (blue, dashed), the ring's
/// circles as fitted (green) with their edge points (yellow), regions that stood over their surroundings (pink; dashed:
/// refused), the chosen connector (orange), the target's axes (X' red, Y' green, Z' blue), and the pose or the refusal
/// in words. Throws InputError where the file cannot be written.
void write_overlay(const std::string& path, const tof::TofFrame& frame, const DepthCamera& camera,
                   const Result<tof::TofPose, tof::TofFailure>& pose, const tof::TofWorkspace& workspace);

}  // namespace pharos::tools
