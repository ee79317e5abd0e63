// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tools/evaluate/trajectory.hpp"

namespace pharos::evaluate {

/// Offset of two clocks, from angular and linear speeds.
struct CoarseOffset {
  std::optional<double> offset_s;  // to add to ESTIMATE's times; none: not observable
  std::string why;                 // message for the user, where there is none
  double correlation = 0.0;        // at the best offset
};

/// The offset with the largest normalised correlation of the two trajectories' angular (or linear) speeds, over all
/// offsets at which half of the shorter one is covered. Angular speed does not depend on the frames and lever arms of
/// the two sides. Accurate to a step of the comparison (5 ms, or 1/8192 of the longer recording); align() refines it.
CoarseOffset coarse_time_offset(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth);

}  // namespace pharos::evaluate
