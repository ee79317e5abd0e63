// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace pharos::tof {

/// The upper one where their number is even; reorders the values. At least one.
inline double median(double* values, std::size_t count) {
  double* middle = values + count / 2;
  std::nth_element(values, middle, values + count);
  return *middle;
}

}  // namespace pharos::tof
