// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// Sensors required by a general (not coplanar) direct linear transformation: eleven unknowns, two equations each. (The
/// paper's four suffice for coplanar sensors only: see homography.hpp.)
inline constexpr int kDltSensors = 6;

/// Direct linear transformation (Hartley and Zisserman, Multiple View Geometry, 2nd ed., section 7.1): the 3x4 matrix
/// that maps body points to rays, solved linearly and made rigid afterwards.
///
/// A poor start for a small, far target (wrong in a third of problems at 8.8 arcsec): the caller must check the
/// reprojection. Empty for fewer than six rays, or where the solution is a mirror image.
StartPoses dlt(const RaySet& set);

}  // namespace pharos::pose
