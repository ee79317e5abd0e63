// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::tof {

/// Median of the absolute residuals to the standard deviation of normally distributed ones.
inline constexpr double kMedianToSigma = 1.4826;

/// The brightest value that an intensity image can hold.
inline constexpr std::uint16_t kFullScale = 65535;

/// Nearer to the ring's centre than this fraction of its outer radius a connector's direction is too inaccurate, and
/// the nozzle is there.
inline constexpr double kMinConnectorDistance = 0.4;

/// Minimum clearance of a connector's centre from the ring, as a fraction of its side: what is nearer is a rest of the
/// ring or its walls.
inline constexpr double kClearOfRing = 0.4;

}  // namespace pharos::tof
