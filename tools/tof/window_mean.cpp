// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/window_mean.hpp"

namespace pharos::tools {

void WindowMean::add(const tof::TofPose& pose) {
  if (has_turn_ && !pose.has_turn()) return;
  if (count_ > 0 && !has_turn_ && pose.has_turn()) *this = WindowMean();
  if (count_ == 0) {
    first_ = pose.target;
    has_turn_ = pose.has_turn();
  }
  sum_ += pose_difference(pose.target.pose, first_.pose);
  covariances_ += pose.target.covariance;
  flags_ |= pose.flags;
  ++count_;
}

std::optional<tof::TargetPose> WindowMean::mean() const {
  if (count_ == 0) return std::nullopt;
  const auto count = static_cast<double>(count_);
  return tof::TargetPose{first_.pose.moved_by(sum_ / count), covariances_ / (count * count)};
}

}  // namespace pharos::tools
