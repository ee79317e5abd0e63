// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/window_mean.hpp"

#include "pharos/geometry/mean_pose.hpp"

namespace pharos::tools {

void WindowMean::add(const tof::TofPose& pose) {
  if (has_turn_ && !pose.has_turn()) return;
  if (!has_turn_ && pose.has_turn()) *this = WindowMean();
  has_turn_ = pose.has_turn();
  flags_ |= pose.flags;
  poses_.push_back(pose.target);
}

std::optional<tof::TargetPose> WindowMean::mean() const {
  if (poses_.empty()) return std::nullopt;
  const auto mean = mean_of_poses(poses_);
  return tof::TargetPose{mean.pose, mean.covariance};
}

}  // namespace pharos::tools
