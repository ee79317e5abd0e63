// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/calibration_file.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/device/camera_settings.hpp"
#include "host/vision/slam/slam_settings.hpp"
#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/pointing/pass.hpp"
#include "pharos/tof/tof_settings.hpp"
#include "pharos/tracking/method_tracker.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::host {

using TrackMethod = tracking::Method;

/// Whom a target's capture board must tell itself to be, by what its greeting holds; empty: anybody.
struct ExpectedIdentity {
  std::optional<std::uint32_t> serial;  // unique id of the board
  std::optional<int> sensors;           // inputs of the board

  bool any() const { return serial.has_value() || sensors.has_value(); }
};

/// One cooperative target: the port that its capture board hangs on and how its pose is found.
struct TargetConfig {
  /// Told in every message: letters, digits, `-` and `_`; no two targets share one.
  std::string name;
  /// A terminal device, or `replay:FILE` for a recorded serial stream.
  std::string port;
  int baud = 460'800;
  ExpectedIdentity identity;
  std::filesystem::path target_file;
  Target target;  // as calibrated, where a calibration is named
  TargetShape shape;
  /// Of `pharos calibrate lighthouse`; empty: the target's table and what stations send hold.
  std::filesystem::path calibration_file;
  std::vector<tracking::KnownStation> calibrated_stations;  // all by id
  std::optional<tracking::CalibratedPair> calibrated_pair;  // of two stations
  double scale_sigma = 0.0;                                 // relative, of the target's size
  /// What nobody knows of sensors and rotors: of the calibration, or without one.
  motion::SystematicErrors systematic = motion::kUncalibratedErrors;
  TrackMethod method = TrackMethod::kMotion;
  track::TrackOptions track;
  motion::UncertaintyLimits limits;  // of method motion
  /// Keep accepted station calibrations in the state directory and use them after a restart.
  bool remember_calibrations = true;

  bool is_replay() const { return port.rfind(kReplayPrefix, 0) == 0; }
  std::filesystem::path replay_file() const { return port.substr(std::string(kReplayPrefix).size()); }
  static constexpr const char* kReplayPrefix = "replay:";
};

/// One depth camera and the docking ring before it.
struct TofConfig {
  /// Told in every message, as `tof/NAME`: letters, digits, `-` and `_`; no two cameras share one.
  std::string name;
  /// Of what it looks at; told in every message.
  std::string target;
  std::filesystem::path camera_file;
  DepthCamera camera;
  /// The camera on the network; its size is that of the camera file.
  CameraSettings device;
  /// Recorded frames (a directory as `pharos sim tof` writes it) in place of a camera on the network; empty: none.
  std::filesystem::path frames;
  tof::TofSettings tof;
  /// A message tells the mean of this many frames; 1: every frame's pose.
  int average_frames = 1;

  bool is_recorded() const { return !frames.empty(); }
};

/// One telescope whose images arrive as files, and the panels before it.
struct PointingConfig {
  /// Told in every message, as `line/NAME`: letters, digits, `-` and `_`; no two telescopes share one.
  std::string name;
  /// Of what it looks at; told in every message.
  std::string target;
  std::filesystem::path camera_file;
  PinholeCamera camera;
  /// Where images arrive.
  std::filesystem::path directory;
  /// Grows by a row an image: image,time_s,azimuth_deg,elevation_deg[,range_m]; time_s is UTC since 1970.
  std::filesystem::path track_file;
  pointing::Geodetic station;
  /// How the target holds its panels during a pass; none: no pass is told, only its images.
  std::optional<pointing::AttitudeLaw> law;
  /// So long without an image ends a pass.
  double pass_gap_s = 60.0;
};

/// What is done to images in low light before anything is looked for: nothing, or enhancement with a denoiser.
enum class LowLight : std::uint8_t { kOff, kBm3d, kFast, kNotDenoised };

/// How a target without a model is followed.
struct SlamConfig {
  SlamConfig() {
    settings.threads = true;
    settings.keep_trajectory = false;
  }
  slam::SlamSettings settings;
  LowLight enhance = LowLight::kOff;
};

/// One rig of two cameras, and what is measured with it.
struct StereoConfig {
  /// Told in every message, as `ring2/NAME` and `slam/NAME`: letters, digits, `-` and `_`; no two rigs share one.
  std::string name;
  /// Of what it looks at; told in every message.
  std::string target;
  std::filesystem::path rig_file;
  RigFile rig;
  /// Left and right camera on the network; their sizes are those of the rig file.
  std::array<CameraSettings, 2> devices;
  /// Two frames whose times differ by no more are a pair. Times told from arrivals differ by a millisecond or two
  /// between cameras; a target that turns 10 deg/s turns 0.05 deg meanwhile.
  double pairing_window_s = 5e-3;
  /// Recorded pairs (a directory as `pharos sim stereo` writes it) in place of cameras on the network; empty: none.
  std::filesystem::path frames;
  bool ring2 = false;
  std::optional<SlamConfig> slam;

  bool is_recorded() const { return !frames.empty(); }
};

struct LcmConfig {
  /// Default: multicast that never leaves this computer (ttl 0).
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  /// Channels are prefix + LIGHTHOUSE_POSE, LIGHTHOUSE_BEARINGS, TOF_POSE, RING2_POSE, SLAM_POSE,
  /// LINE_POINTING, STATUS.
  std::string channel_prefix = "PHAROS_";
};

struct PublishConfig {
  /// A pose whose measurement is older than this when it is ready is counted and not published.
  double max_age_s = 0.2;
  std::int64_t max_age_ns() const { return std::llround(max_age_s * 1e9); }
  double status_period_s = 1.0;
  bool bearings = true;
};

/// Raw serial streams, one file series a target.
struct RecordingConfig {
  std::filesystem::path directory;
  /// A new file begins at whichever comes first.
  std::uint64_t rotate_bytes = 64u << 20;
  double rotate_s = 3600.0;
};

enum class LogSink : std::uint8_t { kStandardError, kSyslog, kFile };

struct LogConfig {
  /// spdlog's words: trace, debug, info, warning, error, critical, off.
  std::string level = "info";
  LogSink sink = LogSink::kStandardError;
  std::filesystem::path file;  // of LogSink::kFile
};

/// What pharosd measures with: a list for each kind of source.
struct SourceConfigs {
  std::vector<TargetConfig> targets;
  std::vector<TofConfig> cameras;
  std::vector<PointingConfig> telescopes;
  std::vector<StereoConfig> stereos;
};

/// Everything that `pharosd` was told.
struct DaemonConfig : SourceConfigs {
  /// Told as the source in every message: which of several daemons.
  std::string source = "pharosd";
  /// Where accepted calibrations live across restarts; empty: nowhere.
  std::filesystem::path state_directory;
  LcmConfig lcm;
  PublishConfig publish;
  std::optional<RecordingConfig> recording;
  LogConfig log;
};

}  // namespace pharos::host
