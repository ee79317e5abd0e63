// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::tools {

/// Spread of repeated measurements of one pose, (23) of paper 002.
struct PoseSpread {
  double rotation_deg = 0.0;  // root mean square angle from the mean rotation
  double position_mm = 0.0;   // root mean square distance from the mean position
};

/// The mean rotation is the one whose rotation vectors to all others add up to zero; the paper takes the mean of the
/// rotation vectors, which is the same for a small spread but fails near a half turn. `poses` must not be empty.
PoseSpread spread_of(const std::vector<LighthouseFromBody>& poses);

/// (25): angle and distance between an estimate and the truth.
struct PoseError {
  double rotation_deg = 0.0;
  double position_mm = 0.0;
};
PoseError error_of(const LighthouseFromBody& estimate, const LighthouseFromBody& truth);

/// Median; `values` must not be empty.
double median_of(std::vector<double> values);
/// Quantile: the value below which `fraction` of the values are.
double quantile_of(std::vector<double> values, double fraction);

}  // namespace pharos::tools
