// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/calibrate/calibration_file.hpp"
#include "host/cameras/camera_file.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/config/daemon_config.hpp"
#include "host/table/target_file.hpp"

namespace pharos::host {

/// What a configuration names outside of itself. Handed in, so that tests and the fuzzer touch no disk.
struct Environment {
  /// How a target file becomes a target; throws InputError.
  std::function<TargetFile(const std::string& path)> read_target;
  /// Throws InputError unless the file is a recorded serial stream that can be read.
  std::function<void(const std::filesystem::path& file)> check_recording;
  /// The same text for every spelling of one port or file: symbolic links, `..`, two device nodes.
  std::function<std::string(const std::string& path)> identity;
  /// How a calibration file becomes a calibration; throws InputError. Unless given, there is none.
  std::function<calibrate::CalibrationFile(const std::string& path)> read_calibration = no_calibration;

  /// How a camera file becomes a camera; throws InputError. Unless given, there is none.
  std::function<CameraFile(const std::string& path)> read_camera = no_camera;
  /// Throws InputError unless there are recorded frames in the directory. Unless given, there are.
  std::function<void(const std::filesystem::path& directory)> check_frames = [](const std::filesystem::path&) {};

  /// How a rig file becomes a rig; throws InputError. Unless given, there is none.
  std::function<RigFile(const std::string& path)> read_rig = no_rig;
  /// Each throws InputError for what its system cannot work with. Unless given, all is well.
  std::function<void(const RigFile& rig)> check_ring2 = [](const RigFile&) {};
  std::function<void(const RigFile& rig, const std::string& name)> check_slam = [](const RigFile&, const std::string&) {
  };
  /// `path` empty: the vocabulary that ships.
  std::function<void(const std::string& path)> check_vocabulary = [](const std::string&) {};
  /// Throws InputError unless there are recorded pairs of this rig in the directory: the first one is read.
  std::function<void(const std::filesystem::path& directory, const RigFile& rig)> check_pairs =
      [](const std::filesystem::path&, const RigFile&) {};

  static RigFile no_rig(const std::string& path);
  static calibrate::CalibrationFile no_calibration(const std::string& path);
  static CameraFile no_camera(const std::string& path);
};

/// This computer's files and devices.
Environment host_environment();

/// Folders, a log file and ports that cannot be what the configuration says, one line each for a person. Nothing is
/// made on the disk, not even the directories where they are missing: then the folder that they would be made in is
/// asked.
std::vector<std::string> directory_errors(const DaemonConfig& config);

}  // namespace pharos::host
