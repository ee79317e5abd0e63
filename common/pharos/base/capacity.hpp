// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pharos {

/// Maximum photodiodes on one target: the width of the capture block's input word (32 bits), and the number on the
/// largest published Lighthouse 1.0 devices (32 on the headset). A firmware for a board of fewer inputs is built with
/// fewer (PharosCompile.cmake): everything stored for a sweep or a cycle is smaller by that.
#ifdef PHAROS_MAX_SENSORS
inline constexpr std::size_t kMaxSensors = PHAROS_MAX_SENSORS;
#else
inline constexpr std::size_t kMaxSensors = 32;
#endif

/// Maximum stations that one target distinguishes: Lighthouse 1.0 interleaves two.
inline constexpr std::size_t kMaxStations = 2;

/// Maximum hits stored for one sweep: every sensor once, and as many again for reflections (two per sensor were seen
/// for two sensors of 24 in the recordings; twice the sensors is a margin for strong reflections).
inline constexpr std::size_t kMaxHitsPerSweep = 2 * kMaxSensors;

}  // namespace pharos
