// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/types.hpp"
#include "pharos/pose/fixed_descent.hpp"

namespace pharos::pose {

/// The pose's covariance for unit variance of one bearing, as unit_covariance with rho 0. False where the matrix is too
/// near to singular, or the body's origin too far from the sensors, for this arithmetic.
bool fixed_unit_covariance(const FixedObservationTable& table, const FixedPose& pose, const FixedNormal& normal,
                           Matrix6& covariance);

}  // namespace pharos::pose
