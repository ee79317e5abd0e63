// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/solve.hpp"
#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Start values for a view by the given method; kAuto is P3P over one wide triplet.
///
/// A method that does not suit the view (DLT: fewer than six sensors, or a reprojection that fails its gate;
/// homography: not coplanar) is replaced by kAuto. Where fewer than three sensors have both bearings attitude_grid
/// replaces all.
StartPoses start_poses(const ObservationTable& table, Start method);

}  // namespace pharos::pose
