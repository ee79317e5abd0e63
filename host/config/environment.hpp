// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/calibrate/calibration_file.hpp"
#include "host/cameras/camera_file.hpp"
#include "host/cameras/docking_target.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/config/daemon_config.hpp"
#include "host/mounting/mounting.hpp"
#include "host/table/target_file.hpp"

namespace pharos::host {

/// Access to files and devices that a configuration names. Passed as an argument, so that tests and the fuzz target do
/// not use the disk.
struct Environment {
  /// Reads a target file; throws InputError.
  std::function<TargetFile(const std::string& path)> read_target;
  /// Throws InputError unless the file is a readable recording of a serial stream, or the directory has one of
  /// `target`.
  std::function<void(const std::filesystem::path& file, const std::string& target)> check_recording;
  /// An identity that is the same for all paths of one port or file: symbolic links, `..`, two device nodes.
  std::function<std::string(const std::string& path)> identity;
  /// Reads a calibration file; throws InputError. If not set, there is none.
  std::function<calibrate::CalibrationFile(const std::string& path)> read_calibration = no_calibration;

  /// Reads a camera file; throws InputError. If not set, there is none.
  std::function<CameraFile(const std::string& path)> read_camera = no_camera;
  /// Whether the frames are those of [recording]; throws InputError unless there are frames of the camera in the
  /// directory. If not set, there are other ones.
  std::function<bool(const std::filesystem::path& directory, const std::string& camera)> check_frames =
      [](const std::filesystem::path&, const std::string&) { return false; };

  /// Reads a rig file; throws InputError. If not set, there is none.
  std::function<RigFile(const std::string& path)> read_rig = no_rig;
  /// Each throws InputError for values that its system cannot use. If not set, all values are valid.
  std::function<void(const RigFile& rig)> check_ring2 = [](const RigFile&) {};
  std::function<void(const RigFile& rig, const std::string& name)> check_slam = [](const RigFile&, const std::string&) {
  };
  /// `path` empty: the installed vocabulary.
  std::function<void(const std::string& path)> check_vocabulary = [](const std::string&) {};
  /// Whether the pairs are those of [recording]; throws InputError unless there are pairs of this rig in the directory;
  /// reads the first one.
  std::function<bool(const std::filesystem::path& directory, const RigFile& rig, const std::string& name)> check_pairs =
      [](const std::filesystem::path&, const RigFile&, const std::string&) { return false; };
  /// How a description of ring and connectors becomes one; throws InputError. Unless given, there is none.
  std::function<DockingTarget(const std::string& path)> read_docking_target = no_docking_target;
  /// The places of a configuration that cannot be used; see place_errors(). If not set, all can.
  std::function<std::vector<PlaceError>(const DaemonConfig& config)> check_places = no_place_errors;

  /// Reads the stations of a room; throws InputError. Unless given, there are none.
  std::function<network::Stations(const std::string& path)> read_stations = no_stations;

  /// Reads a mounting file; throws InputError. Unless given, there is none.
  std::function<Mounting(const std::string& path)> read_mounting = no_mounting;

  static Mounting no_mounting(const std::string& path);
  static network::Stations no_stations(const std::string& path);
  static std::vector<PlaceError> no_place_errors(const DaemonConfig& config);
  static RigFile no_rig(const std::string& path);
  static calibrate::CalibrationFile no_calibration(const std::string& path);
  static CameraFile no_camera(const std::string& path);
  static DockingTarget no_docking_target(const std::string& path);
};

/// The environment of this computer.
Environment host_environment();

/// Folders, log file and ports that cannot be used as configured. Creates nothing on the disk: for a missing directory
/// the folder in which it would be created is checked.
std::vector<PlaceError> place_errors(const DaemonConfig& config);

}  // namespace pharos::host
