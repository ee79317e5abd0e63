// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/geometry/pose.hpp"

namespace pharos::slam {

/// Pose of the target: T_camera_target, where the target's frame equals the left camera's at the first frame.
struct TrackedPose {
  Pose<frame::Camera, frame::Target> pose;
  /// Covariance of delta in Pose::moved_by: that of the frame's own features, plus that of its reference keyframe
  /// relative to the first one. 0 for the first frame, which defines the target's frame.
  Matrix6 covariance = Matrix6::Zero();
  double rms_px = 0.0;  ///< of the inliers' residuals, per coordinate; 0 for the first frame, which has none
};

/// Result of one stereo pair.
struct TrackedFrame {
  std::int64_t number = 0;
  double time_s = 0.0;
  std::optional<TrackedPose> placed;  ///< empty before the first map and while lost
  bool lost = false;
  bool ambiguous_place = false;  ///< lost, though a place was recognised: it contradicts the motion, or another one
  bool keyframe = false;
  bool relocalised = false;
  int features = 0;
  int inliers = 0;
};

}  // namespace pharos::slam
