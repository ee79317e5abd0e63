// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::fusion {

/// Probability that chi-squared of `dof` (1 to 6) degrees of freedom exceeds x >= 0 (Abramowitz and Stegun, 26.4.4 and
/// 26.4.5).
double chi_squared_tail(double x, int dof);

/// The value that chi-squared of `dof` degrees of freedom exceeds with `probability` (1e-300 to 1). 60 bisections.
double chi_squared_bound(double probability, int dof);

}  // namespace pharos::fusion
