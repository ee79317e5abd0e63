// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/solve.hpp"
#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Start values for a view by the method asked for; kAuto is P3P over one wide triplet.
///
/// A method that cannot serve the view (DLT: fewer than six sensors, or a reprojection that fails its gate; homography:
/// not coplanar) gives way to kAuto. Where fewer than three sensors have both bearings all give way to attitude_grid.
StartPoses start_poses(const ObservationTable& table, Start method);

}  // namespace pharos::pose
