// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pharos/tof/tof_pose.hpp"

namespace pharos::tools {

/// The six numbers that people read of a pose, in the order of table 2 of paper 000: X, Y, Z in mm; alpha, beta, gamma
/// in deg.
using PoseNumbers = std::array<double, 6>;
PoseNumbers numbers_of(const tof::CameraFromTarget& pose);
/// Their deviations, from the pose's covariance.
PoseNumbers sigmas_of(const tof::TargetPose& target);

/// Mean and standard deviation of many frames' numbers, as table 2, and the deviation that was foretold.
class PoseSummary {
 public:
  /// `has_turn` false: gamma is left out of this frame.
  void add(const tof::TargetPose& target, bool has_turn);

  std::size_t frames() const { return poses_.size(); }
  /// Frames that gamma comes from.
  std::size_t frames_with_turn() const;
  PoseNumbers mean() const;
  /// With count - 1; 0 of a single frame.
  PoseNumbers deviation() const;
  /// Root mean square of the frames' own sigmas.
  PoseNumbers predicted() const;

 private:
  struct Entry {
    PoseNumbers numbers{};
    PoseNumbers sigmas{};
    bool has_turn = false;
  };
  bool counts(const Entry& entry, std::size_t number) const { return number != 5 || entry.has_turn; }

  std::vector<Entry> poses_;
};

}  // namespace pharos::tools
