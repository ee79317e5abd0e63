// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tof {

/// Median of the absolute residuals to the standard deviation of normally distributed ones.
inline constexpr double kMedianToSigma = 1.4826;

/// The brightest value that an intensity image can hold.
inline constexpr std::uint16_t kFullScale = 65535;

}  // namespace pharos::tof
