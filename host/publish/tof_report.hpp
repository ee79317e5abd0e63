// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/camera_report.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

using TofPoseEstimate = PoseEstimate<frame::Camera, frame::Target>;

/// One frame of a depth camera, or the mean of many: what pose_t is made of.
struct TofReport : CameraReport {
  TofPoseEstimate pose;
};

}  // namespace pharos::host
