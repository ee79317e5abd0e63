// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pharos {

/// Most photodiodes on one target: the width of the capture block's input word (32 bits), and what the largest
/// published Lighthouse 1.0 devices carry (32 on the headset).
/// A firmware for a board of fewer inputs is built with fewer (PharosCompile.cmake): all that is kept of a sweep or a
/// cycle is that much smaller.
#ifdef PHAROS_MAX_SENSORS
inline constexpr std::size_t kMaxSensors = PHAROS_MAX_SENSORS;
#else
inline constexpr std::size_t kMaxSensors = 32;
#endif

/// Most stations one target tells apart: Lighthouse 1.0 interleaves two.
inline constexpr std::size_t kMaxStations = 2;

/// Most hits kept of one sweep: every sensor once, and as many again for reflections (two per sensor were seen for two
/// sensors of 24 in the recordings; twice the sensors leaves room for a hall of mirrors).
inline constexpr std::size_t kMaxHitsPerSweep = 2 * kMaxSensors;

}  // namespace pharos
