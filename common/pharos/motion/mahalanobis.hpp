// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"

namespace pharos::motion {

/// Squared distance of two poses in standard deviations of `allowed`, the covariance of their difference: six degrees
/// of freedom.
double mahalanobis_squared(const LighthouseFromBody& a, const LighthouseFromBody& b, const Matrix6& allowed);

}  // namespace pharos::motion
