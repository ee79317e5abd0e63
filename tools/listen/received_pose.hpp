// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/table/row_pose.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos {
class pose_t;
}  // namespace pharos

namespace pharos::tools {

/// Error of a pose relative to the truth: angle of the relative rotation (paper 002, 23) and distance (25). Of a pose
/// whose turn about its own Z axis is not known, the angle between the Z axes.
struct PoseError {
  double rotation_rad = 0.0;
  double position_m = 0.0;
  std::optional<double> nees =
      std::nullopt;  // normalised error squared per degree of freedom; empty where no covariance holds
};

PoseError pose_error(const LighthouseFromBody& measured, const LighthouseFromBody& truth, bool has_turn = true);

/// Normalised estimation error squared of a pose, per degree of freedom: 1 on average where the covariance (rotation
/// before translation) is right. Empty for a covariance that is not positive.
std::optional<double> pose_nees(const LighthouseFromBody& measured, const LighthouseFromBody& truth,
                                const Matrix6& covariance);

/// What a fused state tells of one of its sources.
struct FusedSource {
  std::string name;
  std::string state;    // used, gated, excluded, conflict, silent
  std::string reason;   // where excluded
  double age_s = -1.0;  // -1: never heard
  double normalised_innovation = 0.0;
};

/// What a fused state tells beside its pose.
struct FusedReading {
  std::string mode;
  Vector3 velocity_m_s = Vector3::Zero();
  Vector3 rate_rad_s = Vector3::Zero();
  std::optional<double> protection_m;  // empty where the level is not available
  std::optional<double> protection_rad;
  std::vector<FusedSource> sources;
};

/// Name of the fusion as a source: a target_state_t has none.
inline constexpr const char* kFusionSource = "fusion";

/// A received pose_t, or the pose of a target_state_t.
struct ReceivedPose {
  std::int64_t utime_us = 0;
  std::int64_t sequence = 0;
  std::string channel;
  std::string source;
  std::string target;
  std::string station_id;
  int station = 0;
  std::string status;
  std::string flags;
  std::optional<LighthouseFromBody> pose;  // empty when the cycle was refused
  Matrix6 covariance = Matrix6::Zero();
  double sigma_rot_rad = 0.0;
  double sigma_pos_m = 0.0;
  bool of_camera = false;  // T_camera_target, T_rig_target of a docking ring: printed as the angles of paper 000
  bool has_turn = true;    // the turn about the target's Z axis is measured, not arbitrary
  double age_s = 0.0;      // on arrival, after the measurement
  double rate_hz = 0.0;    // of its kind over the last second
  std::optional<PoseError> error;
  std::optional<FusedReading> fused;  // of a target_state_t
};

/// Whether it may stand alone in a line of TUM or as a transform. ring2 never measures the turn about the ring's axis:
/// its poses are taken with the conventional one; the pose is there.
host::PoseGrade grade_of(const ReceivedPose& pose);

/// A message as it arrived on `channel` at `utc_ns`.
ReceivedPose received_pose(const std::string& channel, const pose_t& message, std::int64_t utc_ns);

}  // namespace pharos::tools
