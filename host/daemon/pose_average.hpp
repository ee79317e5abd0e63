// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/publish/tof_report.hpp"

namespace pharos::host {

/// One frame's result as input of a mean.
struct AveragedFrame {
  TofPoseEstimate estimate;
  std::int64_t utc_ns = 0;
  int observations = 0;
  std::string flags;
};

/// The mean of a window of frames, with its covariance.
struct WindowMean {
  TofPoseEstimate estimate;
  std::int64_t utc_ns = 0;  // mean of the frames' times
  int observations = 0;
  std::string flags;
  bool moving = false;  // the frames scatter more than their covariances say: the target moved
};

/// Means over consecutive, non-overlapping windows of N frames (paper 000 averages 100 frames of a stationary target).
///
/// Mean and covariance are those of mean_of_poses. Frames with different flags (without a connector one angle is
/// missing) are not mixed; a change of flags or a gap in time starts a new window.
class PoseAverage {
 public:
  explicit PoseAverage(int frames) : frames_(static_cast<std::size_t>(frames)) {}

  /// The mean, when this frame fills the window.
  std::optional<WindowMean> push(const AveragedFrame& frame);
  /// Number of frames in discarded windows.
  std::int64_t discarded() const { return discarded_; }

  static constexpr std::int64_t kLongestGap_ns = 1'000'000'000;
  /// Limit for the reduced chi-squared; for 100 frames of a stationary target it is at most about 1.2.
  static constexpr double kMovingChi2 = 4.0;

 private:
  WindowMean mean() const;

  std::size_t frames_;
  std::vector<AveragedFrame> window_;
  std::int64_t discarded_ = 0;
};

}  // namespace pharos::host
