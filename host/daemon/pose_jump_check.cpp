// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pose_jump_check.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::host {

bool PoseJumpCheck::fits(const Sample& before, const Sample& after) {
  const double tilt_rad = std::acos(std::clamp(before.axis.dot(after.axis), -1.0, 1.0));
  const double moved_m = (after.centre_m - before.centre_m).norm() + kRadius_m * tilt_rad;
  const std::int64_t gap_ns = std::clamp<std::int64_t>(after.time_ns - before.time_ns, 0, kMaxGap_ns);
  const double time_s = static_cast<double>(gap_ns) * 1e-9;
  return moved_m <= kMaxSpeed_m_s * time_s + kSigmas * std::sqrt(before.variance_m2 + after.variance_m2);
}

bool PoseJumpCheck::passes(const Sample& sample) {
  if (last_ && !fits(*last_, sample)) {
    if (sample.time_ns < contested_until_ns_) {
      candidate_.reset();
      return false;
    }
    if (candidate_ && fits(*candidate_, sample)) {
      ++confirmations_;
    } else {
      confirmations_ = 1;
      candidate_since_ns_ = sample.time_ns;
    }
    candidate_ = sample;
    if (confirmations_ < kConfirmations || sample.time_ns - candidate_since_ns_ < kConfirmation_ns) return false;
  }
  last_ = sample;
  candidate_.reset();
  return true;
}

}  // namespace pharos::host
