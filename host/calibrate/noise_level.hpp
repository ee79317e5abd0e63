// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/calibrate/bundle.hpp"

namespace pharos::calibrate {

/// Unmodelled error, 1 sigma on every mean bearing: the level at which the residuals' squares add up to
/// their degrees of freedom; 0 where the noise of the means explains them (within three sigma of their chi-squared).
/// `present_rad` is the level that the residuals' sigmas already include.
double unmodelled_level(const std::vector<BearingResidual>& residuals, double present_rad);

/// Removes bearings from `stills` whose residual is beyond six of their own sigmas and six times the typical one;
/// returns how many. Invalidates the indices of `residuals`.
std::size_t reject_outliers(const std::vector<BearingResidual>& residuals, std::vector<StationaryAverage>& intervals);

}  // namespace pharos::calibrate
