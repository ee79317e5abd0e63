// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// The docking ring's target frame in the rig's frame: origin at the ring's centre, Z' along the normal towards the
/// cameras, X' as close to the rig's x axis as possible. Two circles on one axis do not determine the rotation about
/// it: the variance about Z' is that of a uniform angle (pi^2 / 3 rad^2), as for tof without connector. The second
/// solution is the estimate's. `focal_px` converts the residual to an angle. Precondition: the estimate has the ring's
/// centre (neither kUnobservableScale nor kUnobservableRing).
PoseEstimate<frame::Rig, frame::Target> ring2_pose(const ring2::Ring2Estimate& circles, double focal_px);

}  // namespace pharos::host
