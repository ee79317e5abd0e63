// SPDX-License-Identifier: Apache-2.0
#include "host/config/environment.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "host/device/frame_directory.hpp"
#include "host/device/pair_names.hpp"
#include "host/frame_record/frame_reader.hpp"
#include "host/images/grey_image.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/record/recording_file.hpp"
#include "host/record/stream_reader.hpp"
#include "host/stations/network_file.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"
#include "host/vision/ring2/ring2_detector.hpp"
#include "host/vision/ring2/ring2_rig.hpp"
#include "host/vision/slam/rectification.hpp"
#include "host/vision/slam/vocabulary.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// Opening a pipe would block, and a device is not a recording.
void check_recording(const fs::path& place, const std::string& target) {
  std::error_code error;
  const std::vector<fs::path> files = recording_files(place, target, kStreamSuffix);
  if (files.empty()) throw InputError(place.string() + ": has no recording of target \"" + target + "\"");
  const fs::path& file = files.front();
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw InputError(file.string() + ": is not a file; give a recording made by pharosd's [recording]");
  }
  const StreamReader reads_the_head{ByteSource(file.string())};
}

// Checks the complete optics; the reader of the file checks single values only.
void check_ring2(const RigFile& rig) { static_cast<void>(Ring2Detector(ring2_rig(rig), {})); }

void check_slam(const RigFile& rig, const std::string& name) { static_cast<void>(slam::rectify(rig, name)); }

void check_vocabulary(const std::string& path) {
  static_cast<void>(slam::Vocabulary::read(path.empty() ? slam::shipped_vocabulary_path() : path));
}

void require_size(const std::string& file, const GreyImage& image, const PinholeCamera& intrinsics) {
  if (image.width_px == intrinsics.width_px && image.height_px == intrinsics.height_px) return;
  throw InputError(file + ": has " + std::to_string(image.width_px) + " x " + std::to_string(image.height_px) +
                   " pixels, the rig's camera " + std::to_string(intrinsics.width_px) + " x " +
                   std::to_string(intrinsics.height_px) + "; name the rig file of these cameras");
}

// Whether they are of this camera's size is seen when they are opened.
void check_frame_recording(const fs::path& place, const std::string& camera) {
  const std::vector<fs::path> files = recording_files(place, camera, kFramesSuffix);
  if (files.empty()) throw InputError(place.string() + ": has no recording of camera \"" + camera + "\"");
  const FrameReader reads_the_head{ByteSource(files.front().string())};
}

// Checks the first pair that can be read: unreadable pairs are skipped during the replay.
bool check_pairs(const fs::path& directory, const RigFile& rig, const std::string& name) {
  if (is_frame_recording(directory, side_name(name, 0))) {
    check_frame_recording(directory, side_name(name, 0));
    check_frame_recording(directory, side_name(name, 1));
    return true;
  }
  std::optional<InputError> first_error;
  for (const PairName& pair : pair_names_in(directory.string(), 1.0)) {
    std::array<GreyImage, 2> images;
    try {
      images = {read_grey_image(pair.left), read_grey_image(pair.right)};
    } catch (const InputError& error) {
      if (!first_error) first_error = error;
      continue;
    }
    require_size(pair.left, images[0], rig.left.intrinsics);
    require_size(pair.right, images[1], rig.right.intrinsics);
    return false;
  }
  throw InputError(*first_error);
}

bool check_frames(const fs::path& directory, const std::string& camera) {
  const bool recorded = is_frame_recording(directory, camera);
  if (recorded) {
    check_frame_recording(directory, camera);
  } else {
    static_cast<void>(FrameDirectory(directory.string()));
  }
  return recorded;
}

std::string identity(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0 && S_ISCHR(about.st_mode)) {
    return "device " + std::to_string(major(about.st_rdev)) + ':' + std::to_string(minor(about.st_rdev));
  }
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : real.string();
}

// 0, or the errno of creating a file in `folder`. The test file has no name and is removed when it is closed.
int why_not_writable(const fs::path& folder) {
  const UniqueFd unnamed(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  if (unnamed.valid()) return 0;
  if (errno != EOPNOTSUPP && errno != EISDIR)
    return errno;  // these two: the file system does not support unnamed files
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

// Why nothing can be created in `directory`, or in the folder that it would be created in; empty if it can.
std::string writing_error(const fs::path& directory) {
  std::error_code error;
  fs::path folder = fs::absolute(directory, error).lexically_normal();
  while (folder.has_relative_path() && fs::symlink_status(folder, error).type() == fs::file_type::not_found) {
    folder = folder.parent_path();
  }
  const int reason = why_not_writable(folder);
  if (reason == 0) return "";
  const std::string where = folder == directory ? "" : " (in " + folder.string() + ")";
  return directory.string() + ": cannot be written" + where + ": " + std::strerror(reason) +
         "; change its owner or permissions, or name another";
}

std::string log_error(const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    return file.string() + ": its folder does not exist; create it, or name another";
  if (!fs::exists(file, error)) return writing_error(folder);
  const bool writable = !fs::is_directory(file, error) && ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0;
  return writable ? "" : file.string() + ": cannot be written; name another";
}

// A port may be connected later, but its path must not be something other than a terminal device.
std::string port_error(const TargetConfig& target) {
  if (target.is_replay() || target.port.empty()) return "";
  const fs::path port = target.port;
  std::error_code error;
  if (fs::exists(port, error)) {
    return fs::is_character_file(port, error) ? "" : target.port + ": is no terminal device; name one (/dev/...)";
  }
  const bool may_come = port.string().rfind("/dev/", 0) == 0;  // udev creates folders when devices are connected
  if (may_come || fs::is_directory(port.parent_path(), error)) return "";
  return target.port + ": its folder does not exist; check the path";
}

std::string telescope_error(const PointingConfig& telescope) {
  std::error_code error;
  if (telescope.directory.empty() || fs::is_directory(telescope.directory, error)) return "";
  return telescope.directory.string() + ": is no folder; create it, or name another";
}

}  // namespace

Environment host_environment() {
  return {read_target,      check_recording,   identity,          calibrate::read_calibration_file,
          read_camera_file, check_frames,      read_rig_file,     check_ring2,
          check_slam,       check_vocabulary,  check_pairs,       read_docking_target,
          place_errors,     read_network_file, read_mounting_file};
}

calibrate::CalibrationFile Environment::no_calibration(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

Mounting Environment::no_mounting(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

network::Stations Environment::no_stations(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

std::vector<PlaceError> Environment::no_place_errors(const DaemonConfig&) { return {}; }

RigFile Environment::no_rig(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

CameraFile Environment::no_camera(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

DockingTarget Environment::no_docking_target(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

std::vector<PlaceError> place_errors(const DaemonConfig& config) {
  std::vector<PlaceError> errors;
  const auto add = [&](const char* table, std::size_t index, const char* key, const std::string& message) {
    if (!message.empty()) errors.push_back({table, index, key, message});
  };
  if (!config.state_directory.empty()) add("", 0, "state_directory", writing_error(config.state_directory));
  if (config.recording && !config.recording->directory.empty()) {
    add("recording", 0, "directory", writing_error(config.recording->directory));
  }
  if (config.log.sink == LogSink::kFile && !config.log.file.empty()) add("log", 0, "file", log_error(config.log.file));
  for (std::size_t i = 0; i < config.targets.size(); ++i) add("target", i, "port", port_error(config.targets[i]));
  for (std::size_t i = 0; i < config.telescopes.size(); ++i) {
    add("telescope", i, "directory", telescope_error(config.telescopes[i]));
  }
  return errors;
}

}  // namespace pharos::host
