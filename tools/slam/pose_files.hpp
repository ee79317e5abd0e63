// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/vision/slam/tracked_frame.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// How poses are written: lines of TUM (timestamp tx ty tz qx qy qz qw), or a table (CSV or JSON) with sigmas.
struct PoseFile {
  OutputOptions output;
  bool of_camera = false;  // the inverse poses
};

/// Frames with a pose, and in a table those without as refused. Returns how many have one. Throws InputError where it
/// cannot be written.
int write_poses(const PoseFile& file, const std::vector<slam::TrackedFrame>& trajectory);

/// The pose's inverse: T_target_camera, the covariance that of its own delta.
struct InversePose {
  Pose<frame::Target, frame::Camera> pose;
  Matrix6 covariance = Matrix6::Zero();
};
InversePose inverse_of(const slam::TrackedPose& placed);

}  // namespace pharos::tools
