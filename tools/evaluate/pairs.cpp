// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/pairs.hpp"

namespace pharos::evaluate {

Pairs pair_up(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth, double time_offset_s,
              double max_gap_s) {
  Pairs result;
  for (const Sample<EstimatePose>& sample : estimate) {
    const double time_s = sample.time_s + time_offset_s;
    if (const auto there = pose_at(truth, time_s, max_gap_s)) {
      result.pairs.push_back({sample, *there});
    } else if (truth.empty() || time_s < truth.front().time_s || time_s > truth.back().time_s) {
      ++result.outside;
    } else {
      ++result.in_gap;
    }
  }
  return result;
}

}  // namespace pharos::evaluate
