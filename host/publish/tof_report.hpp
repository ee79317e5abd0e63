// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/publish/frame_names.hpp"
#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

using TofPoseEstimate = PoseEstimate<frame::Camera, frame::Target>;

/// One frame of a depth camera, or the mean of many: content of a pose_t.
struct TofReport : MeasurementHeader {
  TofReport() { frames = frames_of(pose); }

  TofPoseEstimate pose;
};

const char* channel_of(const TofReport& report);
bool is_finite(const TofReport& report);

}  // namespace pharos::host
