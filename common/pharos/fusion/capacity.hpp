// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pharos::fusion {

/// Sources of poses: two lighthouse stations, tof, ring2 and slam; a sixth would cost 50 KiB of the state's 256.
inline constexpr std::size_t kMaxSources = 5;
/// Pose (rotation rad, position m), then rates (angular velocity rad/s, velocity m/s).
inline constexpr int kKinematic = 12;
inline constexpr int kBias = 6;
inline constexpr int kStates = kKinematic + kBias * static_cast<int>(kMaxSources);
/// Measurements kept for those that arrive late: 0.3 s at 180 a second.
inline constexpr std::size_t kMaxBuffered = 54;
/// Copies of the state that late measurements start from.
inline constexpr std::size_t kSnapshots = 3;

}  // namespace pharos::fusion
