// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "host/publish/frame_names.hpp"
#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// Of the docking ring, before the rig (system ring2). residual_rms is an angle: pixels over the focal length.
using Ring2PoseEstimate = PoseEstimate<frame::Rig, frame::Target>;
/// Of a target without a model, before the left camera (system slam): where it is relative to the first pair of the
/// map, T_C_T with T equal to C then. residual_rms as above.
using SlamPoseEstimate = PoseEstimate<frame::Camera, frame::Target>;
using Ring2Pose = std::variant<Ring2PoseEstimate, SlamPoseEstimate>;

/// A pair of images of a rig: what pose_t is made of. Which system it is of, its pose's frames tell.
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
