// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tools/evaluate/trajectory.hpp"

namespace pharos::evaluate {

/// One pose of ESTIMATE and the truth at its instant.
struct Pair {
  Sample<EstimatePose> estimate;  // time_s on ESTIMATE's own clock
  Moving<TruthPose> truth;
};

/// Outcome of ESTIMATE's poses: compared, or why not.
struct Pairs {
  std::vector<Pair> pairs;
  std::size_t outside = 0;  // before TRUTH's first pose or after its last
  std::size_t in_gap = 0;   // where TRUTH has a gap
};

/// Interpolates TRUTH at the times of ESTIMATE, whose clock is `time_offset_s` behind TRUTH's.
Pairs pair_up(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth, double time_offset_s,
              double max_gap_s);

}  // namespace pharos::evaluate
