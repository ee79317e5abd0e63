// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/listen/received_pose.hpp"

namespace pharos::tools {

/// What tells one source's row from another's.
struct SourceKey {
  std::string channel;
  std::string source;
  std::string target;
  int station = 0;

  auto operator<=>(const SourceKey&) const = default;
};

/// Of a valid pose_t, what a ReceivedPose leaves out.
struct PoseDetails {
  std::string parent_frame;
  std::string child_frame;
  double residual_rms_rad = 0.0;
  int observations = 0;
  std::optional<LighthouseFromBody> second;  // fits nearly as well
};

/// Direction of a target's axis in the station's frame (east, north, up).
struct AxisReading {
  Vector3 axis = Vector3::Zero();
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
  double sigma_rad = 0.0;
};

/// Angular velocity of a target.
struct SpinReading {
  Vector3 rate_rad_s = Vector3::Zero();
  double sigma_rad_s = 0.0;
};

/// One photodiode in the newest cycle of a station: its direction from the station as x/z and y/z, where both planes
/// hit it.
struct SensorSight {
  std::optional<double> x_over_z;
  std::optional<double> y_over_z;
  bool used = false;  // at least one of its angles was; otherwise it is lit, and rejected
};

/// The newest light of one station on one target.
struct Sights {
  std::int64_t arrived_ns = 0;
  bool calibrated = false;
  std::array<std::optional<SensorSight>, 32> sensors;  // by number
};

/// One source on one target (of one station): its newest message, its newest valid one, and how they come. Times are
/// monotonic, or those of a log.
struct SourceRow {
  std::string by;      // station or camera
  std::string status;  // of the newest message
  std::string flags;
  std::optional<ReceivedPose> pose;  // newest valid one
  PoseDetails details;               // of it
  std::optional<AxisReading> axis;
  std::optional<SpinReading> spin;
  std::optional<FusedReading> fused;     // of the newest message, valid or not; its pose is in `pose`
  double age_at_arrival_s = 0.0;         // of the newest valid one
  std::int64_t heard_ns = 0;             // newest message
  std::int64_t valid_ns = 0;             // newest valid one; 0: none yet
  std::deque<std::int64_t> arrivals_ns;  // valid ones of the last second
  std::int64_t refused = 0;
  std::int64_t lost = 0;     // gaps in the sequence numbers that were noticed here
  std::int64_t version = 0;  // grows with every message

  bool any() const { return valid_ns != 0; }
  /// Since the measurement, s.
  double age_s(std::int64_t now_ns) const { return age_at_arrival_s + static_cast<double>(now_ns - valid_ns) * 1e-9; }
  /// A value that is no longer current must not look as if it were: true for 1.5 s.
  bool current(std::int64_t now_ns) const { return any() && now_ns - valid_ns < 1'500'000'000; }
};

/// The newest picture of one camera, of a rig of one of its views.
struct CameraPreview {
  std::string channel, source, camera, view, target;
  std::string status;  // of the measurement made from it
  std::int64_t utime_us = 0;
  double age_at_arrival_s = 0.0;
  std::int64_t heard_ns = 0;
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t sequence = 0;
  std::shared_ptr<const std::vector<std::uint8_t>> jpeg;  // shared with whoever sends it on

  double age_s(std::int64_t now_ns) const { return age_at_arrival_s + static_cast<double>(now_ns - heard_ns) * 1e-9; }
  /// They come twice a second.
  bool current(std::int64_t now_ns) const { return now_ns - heard_ns < 1'500'000'000; }
};

/// What a daemon tells of one of its sources.
struct SourceHealth {
  std::string state;
  std::string message;
  double data_age_s = -1.0;  // -1: never
  std::string ptp;           // of its cameras, where they are asked to follow PTP
};

/// What a daemon tells of itself.
struct DaemonState {
  std::string version;
  std::string state;
  std::string message;
  std::int64_t heard_ns = 0;
  std::map<std::pair<std::string, std::string>, SourceHealth> sources;  // by source and target

  /// pharosd tells its state once a second.
  bool silent(std::int64_t now_ns) const { return now_ns - heard_ns > 3'000'000'000; }
};

/// A change that an operator wants to know: LOST, FOUND, another state of a daemon.
struct SourceEvent {
  std::int64_t number = 0;  // from 1
  std::string text;
};

}  // namespace pharos::tools
