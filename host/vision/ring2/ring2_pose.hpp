// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// The docking ring's target frame before the rig: origin in the ring's centre, Z' along the normal towards the
/// cameras, X' as near to the rig's x axis as can be. Two circles on one axis do not tell the turn about it: the
/// covariance about Z' is that of any turn (pi^2 / 3 rad^2), as where tof finds no connector. The second solution is
/// the estimate's.
/// `focal_px` makes an angle of the residual. Of estimates that tell the ring's centre (untold has neither
/// kUnobservableScale nor kUnobservableRing).
PoseEstimate<frame::Rig, frame::Target> ring2_pose(const ring2::Ring2Estimate& circles, double focal_px);

}  // namespace pharos::host
