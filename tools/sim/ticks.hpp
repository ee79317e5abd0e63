// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::sim {

/// One tick of the capture's counter: 50 MHz.
inline constexpr double kTick_s = 20e-9;

inline double seconds(double ticks) { return ticks * kTick_s; }

}  // namespace pharos::sim
