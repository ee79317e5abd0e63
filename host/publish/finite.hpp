// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// Whether every number of a pose that is part of a message is finite.
template <class Parent, class Child>
bool is_finite(const PoseEstimate<Parent, Child>& estimate) {
  const bool second_is_finite =
      !estimate.second || (estimate.second->pose.is_finite() && std::isfinite(estimate.second->delta_chi2));
  return estimate.pose.is_finite() && estimate.covariance.allFinite() && std::isfinite(estimate.residual_rms) &&
         std::isfinite(estimate.adop_deg_per_rad) && std::isfinite(estimate.pdop_m_per_rad) && second_is_finite;
}

}  // namespace pharos::host
