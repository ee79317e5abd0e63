// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace pharos {

/// Variance of the mean of many draws over that of as many independent ones, where noise is alike for `time_s`
/// (first-order Gauss-Markov) and the draws are `step_s` apart: (1 + rho) / (1 - rho), rho = exp(-step / time). 1 where
/// either is not positive.
inline double noise_correlation(double time_s, double step_s) {
  if (!(time_s > 0.0 && step_s > 0.0)) return 1.0;
  const double steps = step_s / time_s;
  return (1.0 + std::exp(-steps)) / -std::expm1(-steps);
}

}  // namespace pharos
