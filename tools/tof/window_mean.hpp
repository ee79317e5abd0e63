// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "pharos/tof/tof_pose.hpp"

namespace pharos::tools {

/// Mean of the poses that some frames of a target at rest gave (paper 000 averages 100), refused ones left out.
///
/// Frames without the turn about Z' count only while no frame has it. The covariance is that of the mean of independent
/// frames: the sum of theirs over the count squared.
class WindowMean {
 public:
  void add(const tof::TofPose& pose);

  std::size_t frames() const { return count_; }
  bool has_turn() const { return has_turn_; }
  std::uint8_t flags() const { return flags_; }
  /// Nothing while nothing was added.
  std::optional<tof::TargetPose> mean() const;

 private:
  tof::TargetPose first_;
  Vector6 sum_ = Vector6::Zero();  // of differences from the first pose
  Matrix6 covariances_ = Matrix6::Zero();
  std::size_t count_ = 0;
  bool has_turn_ = false;
  std::uint8_t flags_ = 0;
};

}  // namespace pharos::tools
