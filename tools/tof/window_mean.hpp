// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pharos/tof/tof_pose.hpp"

namespace pharos::tools {

/// Mean of the poses that some frames of a target at rest gave (paper 000 averages 100), refused ones left out.
///
/// Frames without the turn about Z' count only while no frame has it. Mean and covariance are those of mean_of_poses.
class WindowMean {
 public:
  void add(const tof::TofPose& pose);

  std::size_t frames() const { return poses_.size(); }
  bool has_turn() const { return has_turn_; }
  std::uint8_t flags() const { return flags_; }
  /// Nothing while nothing was added.
  std::optional<tof::TargetPose> mean() const;

 private:
  std::vector<tof::TargetPose> poses_;
  bool has_turn_ = false;
  std::uint8_t flags_ = 0;
};

}  // namespace pharos::tools
