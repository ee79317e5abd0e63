// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/publish/tof_report.hpp"

namespace pharos::host {

/// One frame's answer, as a mean takes it.
struct AveragedFrame {
  TofPoseEstimate estimate;
  std::int64_t utc_ns = 0;
  int observations = 0;
  std::string flags;
};

/// The mean of a window of frames, and how far to believe it.
struct WindowMean {
  TofPoseEstimate estimate;
  std::int64_t utc_ns = 0;  // mean of the frames'
  int observations = 0;
  std::string flags;
  bool moving = false;  // the frames scatter more than their covariances say: the target moved
};

/// Means of N frames in a row (paper 000 takes 100 of a target at rest), one after another, no frame in two of them.
///
/// The mean and its covariance are those of mean_of_poses. Frames of different flags (without a connector one angle is
/// missing) are not mixed, and a window is not continued over a gap: it begins anew.
class PoseAverage {
 public:
  explicit PoseAverage(int frames) : frames_(static_cast<std::size_t>(frames)) {}

  /// The mean, when this frame fills the window.
  std::optional<WindowMean> push(const AveragedFrame& frame);
  /// Frames that were in a window that was given up.
  std::int64_t discarded() const { return discarded_; }

  static constexpr std::int64_t kLongestGap_ns = 1'000'000'000;
  /// Reduced chi-squared: with 100 frames chance reaches 1.2.
  static constexpr double kMovingChi2 = 4.0;

 private:
  WindowMean mean() const;

  std::size_t frames_;
  std::vector<AveragedFrame> window_;
  std::int64_t discarded_ = 0;
};

}  // namespace pharos::host
