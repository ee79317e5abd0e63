// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/publish/frame_names.hpp"
#include "host/publish/measurement_header.hpp"
#include "pharos/base/axis.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// One cycle of one station on one target: content of a pose_t. The header's sensor is the station, eight hex digits,
/// empty while unknown.
struct CycleReport : MeasurementHeader {
  CycleReport() { frames = frames_of(pose); }

  std::uint8_t station = 0;  // slot position
  LighthousePoseEstimate pose;
};

using WorldPoseEstimate = PoseEstimate<frame::World, frame::Body>;

/// One sweep of one of the stations of a room, with the pose in the world that all of them give: content of a pose_t on
/// the channel of CycleReport. Its station is 0: the pose is not of one station.
struct WorldPoseReport : MeasurementHeader {
  WorldPoseReport() { frames = frames_of(pose); }

  WorldPoseEstimate pose;
};

/// The same for a board pose.
struct BoardPoseReport : CycleReport {};

/// One bearing of a cycle, with its residual from the solver.
struct ReportedBearing {
  std::uint8_t sensor = 0;
  Axis axis = Axis::kX;
  std::uint16_t width_ticks = 0;
  std::int64_t offset_ns = 0;  // middle of the pulse after the cycle's time
  double raw_theta_rad = 0.0;
  double ideal_theta_rad = 0.0;
  bool used = false;
  double residual_rad = 0.0;
};

/// The bearings of a cycle: content of a bearings_t. Header and station are those of the cycle.
struct BearingsReport : MeasurementHeader {
  std::uint8_t station = 0;
  bool calibrated = false;  // ideal_theta_rad is corrected by the station's calibration
  std::vector<ReportedBearing> bearings;
};

const char* channel_of(const CycleReport& report);
const char* channel_of(const WorldPoseReport& report);
const char* channel_of(const BoardPoseReport& report);
const char* channel_of(const BearingsReport& report);
bool is_finite(const CycleReport& report);
bool is_finite(const WorldPoseReport& report);
bool is_finite(const BearingsReport& report);

}  // namespace pharos::host
