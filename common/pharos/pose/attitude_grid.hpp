// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Starts for views in which fewer than three sensors have both bearings: attitudes spread over all rotations, each
/// with the translation that follows linearly from its bearings (a bearing is a plane through the station that contains
/// the sensor). The eight that fit best, best first. Cost: some 15 us; used only where no ray triplet exists.
StartPoses attitude_grid(const ObservationTable& table);

}  // namespace pharos::pose
