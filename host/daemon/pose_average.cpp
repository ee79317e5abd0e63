// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pose_average.hpp"

#include <cmath>

#include "pharos/geometry/mean_pose.hpp"

namespace pharos::host {

std::optional<WindowMean> PoseAverage::push(const AveragedFrame& frame) {
  const bool continues = window_.empty() || (window_.back().flags == frame.flags &&
                                             frame.utc_ns - window_.back().utc_ns <= kLongestGap_ns);
  if (!continues) {
    discarded_ += static_cast<std::int64_t>(window_.size());
    window_.clear();
  }
  window_.push_back(frame);
  if (window_.size() < frames_) return std::nullopt;
  WindowMean result = mean();
  window_.clear();
  return result;
}

WindowMean PoseAverage::mean() const {
  std::vector<TofPoseEstimate> estimates;
  WindowMean result;
  double after_first_ns = 0.0;
  for (const AveragedFrame& frame : window_) {
    estimates.push_back(frame.estimate);
    result.observations += frame.observations;
    after_first_ns += static_cast<double>(frame.utc_ns - window_.front().utc_ns);
  }
  const auto mean = mean_of_poses(estimates);
  result.estimate = estimates.back();
  result.estimate.pose = mean.pose;
  result.estimate.covariance = mean.covariance;
  result.utc_ns = window_.front().utc_ns + std::llround(after_first_ns / static_cast<double>(window_.size()));
  result.flags = window_.back().flags;
  result.moving = !(mean.reduced_chi2 < kMovingChi2);
  return result;
}

}  // namespace pharos::host
