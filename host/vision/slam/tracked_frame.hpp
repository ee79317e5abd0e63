// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/geometry/pose.hpp"

namespace pharos::slam {

/// Where the target is: T_camera_target with the target's frame equal to the left camera's own at the first frame.
struct TrackedPose {
  Pose<frame::Camera, frame::Target> pose;
  /// Of delta in Pose::moved_by: what the frame's own features leave open, and how well the keyframe that it is told
  /// from stands relative to the first one. Of the first frame, which is where it is by definition, 0.
  Matrix6 covariance = Matrix6::Zero();
  double rms_px = 0.0;  ///< of the inliers' residuals, a coordinate each; of the first frame, which has none, 0
};

/// One stereo pair and what came of it.
struct TrackedFrame {
  std::int64_t number = 0;
  double time_s = 0.0;
  std::optional<TrackedPose> placed;  ///< empty while waiting for a first map or lost
  bool lost = false;
  bool keyframe = false;
  bool relocalised = false;
  int features = 0;
  int inliers = 0;
};

}  // namespace pharos::slam
