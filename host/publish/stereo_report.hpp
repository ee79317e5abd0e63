// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "host/publish/frame_names.hpp"
#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// Pose of the docking ring in the rig's frame (system ring2). residual_rms is an angle: pixels over the focal length.
using Ring2PoseEstimate = PoseEstimate<frame::Rig, frame::Target>;
/// Pose of a target without a model in the left camera's frame (system slam): T_C_T, where T equals C at the first pair
/// of the map. residual_rms as above.
using SlamPoseEstimate = PoseEstimate<frame::Camera, frame::Target>;
using Ring2Pose = std::variant<Ring2PoseEstimate, SlamPoseEstimate>;

/// A pair of images of a rig: content of a pose_t. The frames of its pose identify the system.
struct StereoReport : MeasurementHeader {
  explicit StereoReport(const Ring2Pose& measured = {}) : pose(measured) {
    frames = frames_of(pose);
    ambiguous = std::visit([](const auto& one) { return one.ambiguous(); }, pose);
  }

  bool of_slam() const { return std::holds_alternative<SlamPoseEstimate>(pose); }

  Ring2Pose pose;
};

const char* channel_of(const StereoReport& report);
bool is_finite(const StereoReport& report);

}  // namespace pharos::host
