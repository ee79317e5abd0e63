// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "host/device/depth_frame.hpp"
#include "host/preview/drawing.hpp"
#include "host/publish/tof_report.hpp"
#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/connector_pair.hpp"
#include "pharos/tof/tof_settings.hpp"
#include "pharos/tof/tof_stages.hpp"

namespace pharos::tof {
struct TofPose;
struct TofWorkspace;
}  // namespace pharos::tof

namespace pharos::host {

/// Result of one frame: a refusal is a tof::name_of(TofFailure); observations are depth pixels and edge points.
struct TofResult : MeasurementOutcome {
  TofPoseEstimate estimate;
  /// Duration of each stage, by TofStage; 0 for stages that the frame did not reach.
  std::array<std::int64_t, tof::kTofStages> stage_ns{};
};

/// Computes a pose from a frame: the core's measure_tof_pose with its own workspace, the turn by both connectors where
/// earlier frames have told how they stand.
class TofEstimator {
 public:
  TofEstimator(const DepthCamera& camera, const tof::TofSettings& settings);
  ~TofEstimator();

  /// Scale and offset of the frame take precedence over those of the camera file.
  TofResult measure(const DepthFrame& frame);
  /// What the last measure() found in its frame: ring, connector and axes, or all ellipses.
  Drawing drawing() const;

 private:
  DepthCamera camera_;
  tof::TofSettings settings_;
  std::unique_ptr<tof::TofWorkspace> workspace_;
  tof::ConnectorPair pair_;
  std::unique_ptr<tof::TofPose> last_;  // of the last frame; null where it has none
};

/// The camera with the scale of this frame.
DepthCamera camera_of(const DepthFrame& frame, const DepthCamera& by_file);

}  // namespace pharos::host
