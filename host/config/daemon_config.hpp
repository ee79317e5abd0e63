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
#include "host/config/remote_config.hpp"
#include "host/config/vehicle_config.hpp"
#include "host/device/camera_settings.hpp"
#include "host/vision/slam/slam_settings.hpp"
#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/network/station.hpp"
#include "pharos/pointing/pass.hpp"
#include "pharos/tof/tof_settings.hpp"
#include "pharos/tracking/method_tracker.hpp"
#include "pharos/tracking/station_survey.hpp"

namespace pharos::host {

using TrackMethod = tracking::Method;

/// The identity that a target's capture board must have in its hello message; empty: any.
struct ExpectedIdentity {
  std::optional<std::uint32_t> serial;  // unique id of the board
  std::optional<int> sensors;           // inputs of the board

  bool any() const { return serial.has_value() || sensors.has_value(); }
};

/// One cooperative target: the port of its capture board and how its pose is computed.
struct TargetConfig {
  /// Part of every message: letters, digits, `-` and `_`; unique among the targets.
  std::string name;
  /// A terminal device, or `replay:FILE` for a recorded serial stream.
  std::string port;
  int baud = 460'800;
  ExpectedIdentity identity;
  std::filesystem::path target_file;
  Target target;  // with calibrated positions if there is a calibration file
  TargetShape shape;
  /// Of the stations: 1, or 2 with the room's stations from a file.
  int generation = 1;
  std::filesystem::path stations_file;
  network::Stations stations;
  /// Of `pharos calibrate lighthouse`; empty: the target's table and the stations' OOTX data are used.
  std::filesystem::path calibration_file;
  std::vector<tracking::KnownStation> calibrated_stations;  // all by id
  std::optional<tracking::CalibratedPair> calibrated_pair;  // of two stations
  double scale_sigma = 0.0;                                 // relative, of the target's size
  /// Systematic errors of sensors and rotors: from the calibration, or those without one.
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

/// One depth camera and the docking ring in front of it.
struct TofConfig {
  /// Part of every message, as `tof/NAME`: letters, digits, `-` and `_`; unique among the cameras.
  std::string name;
  /// Name of the observed target; part of every message.
  std::string target;
  std::filesystem::path camera_file;
  DepthCamera camera;
  /// The camera on the network; its size is that of the camera file.
  CameraSettings device;
  /// Recorded frames (a directory as `pharos sim tof` writes it, or what [recording] made of this camera) in place of a
  /// camera on the network; empty: none.
  std::filesystem::path frames;
  /// They are what [recording] made: with the camera's times, and checked as the camera's.
  bool replays_camera = false;
  /// Description of ring and connectors, whose values are in `tof`; empty: none.
  std::filesystem::path target_file;
  tof::TofSettings tof;
  /// A message has the mean pose of this number of frames; 1: every frame's pose.
  int average_frames = 1;

  bool is_recorded() const { return !frames.empty(); }
  /// Of any views, at times that are made up.
  bool is_loose() const { return is_recorded() && !replays_camera; }
};

/// One telescope whose images arrive as files, and the panels that it observes.
struct PointingConfig {
  /// Part of every message, as `line/NAME`: letters, digits, `-` and `_`; unique among the telescopes.
  std::string name;
  /// Name of the observed target; part of every message.
  std::string target;
  std::filesystem::path camera_file;
  PinholeCamera camera;
  /// Directory in which images arrive.
  std::filesystem::path directory;
  /// Gets one row per image: image,time_s,azimuth_deg,elevation_deg[,range_m]; time_s is UTC since 1970.
  std::filesystem::path track_file;
  pointing::Geodetic station;
  /// How the target holds its panels during a pass; none: only images are reported, no passes.
  std::optional<pointing::AttitudeLaw> law;
  /// Time without an image after which a pass ends.
  double pass_gap_s = 60.0;
};

/// Processing of low-light images before detection: none, or enhancement with a denoiser.
enum class LowLight : std::uint8_t { kOff, kBm3d, kFast, kNotDenoised };

/// Settings for tracking a target without a model.
struct SlamConfig {
  SlamConfig() {
    settings.threads = true;
    settings.keep_trajectory = false;
  }
  slam::SlamSettings settings;
  LowLight enhance = LowLight::kOff;
};

/// One rig of two cameras, and the systems that use it.
struct StereoConfig {
  /// Part of every message, as `ring2/NAME` and `slam/NAME`: letters, digits, `-` and `_`; unique among the rigs.
  std::string name;
  /// Name of the observed target; part of every message.
  std::string target;
  std::filesystem::path rig_file;
  RigFile rig;
  /// Left and right camera on the network; their sizes are those of the rig file.
  std::array<CameraSettings, 2> devices;
  /// Maximum time difference of the frames of a pair. Times derived from arrivals differ by one or two milliseconds
  /// between cameras; a target that rotates at 10 deg/s rotates by 0.05 deg in 5 ms.
  double pairing_window_s = 5e-3;
  /// Recorded pairs (a directory as `pharos sim stereo` writes it, or what [recording] made of these cameras) in place
  /// of cameras on the network; empty: none.
  std::filesystem::path frames;
  /// As TofConfig::replays_camera.
  bool replays_camera = false;
  bool ring2 = false;
  std::optional<SlamConfig> slam;

  bool is_recorded() const { return !frames.empty(); }
  /// Of any views, at times that are made up.
  bool is_loose() const { return is_recorded() && !replays_camera; }
};

struct LcmConfig {
  /// Default: multicast that never leaves this computer (ttl 0).
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  /// Channels are prefix + LIGHTHOUSE_POSE, LIGHTHOUSE_BEARINGS, TOF_POSE, RING2_POSE, SLAM_POSE,
  /// LINE_POINTING, TARGET_STATE, PREVIEW, STATUS.
  std::string channel_prefix = "PHAROS_";
  /// On which daemons compare their clocks; the same for all of them.
  std::string clock_channel = "PHAROS_CLOCK";
  /// Answer other daemons that compare their clocks with this one's.
  bool answer_clock = false;
};

struct PublishConfig {
  /// A pose whose measurement is older than this when it is ready is counted and not published.
  double max_age_s = 0.2;
  std::int64_t max_age_ns() const { return std::llround(max_age_s * 1e9); }
  double status_period_s = 1.0;
  bool bearings = true;
  /// Pictures of cameras, telescopes and rigs, with what was found drawn in, for people.
  bool previews = false;
};

/// Recording of raw serial streams and of cameras' frames, one series of files per target and camera.
struct RecordingConfig {
  std::filesystem::path directory;
  /// A new file begins at whichever comes first.
  std::uint64_t rotate_bytes = 64u << 20;
  double rotate_s = 3600.0;
  /// Whether cameras are recorded: 37 MB/s for a Helios at 30 frames/s.
  bool cameras = false;
  /// Of all files of one camera: the oldest whole ones are deleted for new ones.
  std::uint64_t camera_limit_bytes = std::uint64_t{100} << 30;
};

enum class LogSink : std::uint8_t { kStandardError, kSyslog, kFile };

struct LogConfig {
  /// spdlog's words: trace, debug, info, warning, error, critical, off.
  std::string level = "info";
  LogSink sink = LogSink::kStandardError;
  std::filesystem::path file;  // of LogSink::kFile
};

/// The sources of pharosd: a list for each kind.
struct SourceConfigs {
  std::vector<TargetConfig> targets;
  std::vector<TofConfig> cameras;
  std::vector<PointingConfig> telescopes;
  std::vector<StereoConfig> stereos;
  std::vector<RemoteConfig> remotes;
};

/// A folder, log file or port that cannot be used as configured.
struct PlaceError {
  std::string table;      // empty: the top level
  std::size_t index = 0;  // of several tables of that name
  std::string key;
  std::string message;  // read from a file: with file, line and key
};

/// The complete configuration of `pharosd`.
struct DaemonConfig : SourceConfigs {
  /// Part of every message; identifies one of several daemons.
  std::string source = "pharosd";
  /// Directory that stores accepted calibrations across restarts; empty: they are not stored.
  std::filesystem::path state_directory;
  LcmConfig lcm;
  PublishConfig publish;
  std::optional<RecordingConfig> recording;
  /// The state of one target from all sources; empty: each source's poses only.
  std::optional<VehicleConfig> vehicle;
  LogConfig log;
  /// Found when the file was read. Poses need none of these places: they are reported and do not prevent a start.
  std::vector<PlaceError> place_errors;
};

}  // namespace pharos::host
