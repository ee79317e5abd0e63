// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tools/evaluate/trajectory.hpp"

namespace pharos::evaluate {

/// How far two clocks are apart, as turning and moving tell it.
struct CoarseOffset {
  std::optional<double> offset_s;  // to add to ESTIMATE's times; none: the motion does not tell
  std::string why;                 // for people, where there is none
  double correlation = 0.0;        // at the best offset
};

/// The offset at which the two trajectories turn (or move) alike: the greatest normalised correlation of their speeds
/// over all offsets at which half of the shorter one is covered. Turning is the same whatever the frames and lever arms
/// of the two sides. Good to a step of the comparison (5 ms, or 1/8192 of the longer recording); align() refines it.
CoarseOffset coarse_time_offset(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth);

}  // namespace pharos::evaluate
