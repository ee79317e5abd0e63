// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace pharos::convert {

/// The lower envelope of `values` over `times_s` (ascending): a delay is never negative, so what was delayed least
/// within
/// +-0.6 s or so tells the time itself. Bins of 0.2 s give their 20 % quantile (a single value too early has no
/// effect), and each place the least of its bin and the three on either side. One value a time.
std::vector<double> lower_envelope(const std::vector<double>& times_s, const std::vector<double>& values);

}  // namespace pharos::convert
