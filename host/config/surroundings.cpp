// SPDX-License-Identifier: Apache-2.0
#include "host/config/surroundings.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/device/frame_directory.hpp"
#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// A pipe would hang whoever opens it, a folder or a device is no recording either.
void check_recording(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw InputError(file.string() + ": is not a file; give a recording made by pharosd's [recording]");
  }
  const StreamReader reads_the_head{ByteSource(file.string())};
}

void check_frames(const fs::path& directory) { static_cast<void>(FrameDirectory(directory.string())); }

std::string identity(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0 && S_ISCHR(about.st_mode)) {
    return "device " + std::to_string(major(about.st_rdev)) + ':' + std::to_string(minor(about.st_rdev));
  }
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : real.string();
}

// 0, or the errno that a new file in `folder` would meet. The file tried has no name and is gone when it is closed.
int why_not_writable(const fs::path& folder) {
  const UniqueFd unnamed(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  if (unnamed.valid()) return 0;
  if (errno != EOPNOTSUPP && errno != EISDIR) return errno;  // those two: a file system that knows no unnamed files
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

void add_trouble(std::vector<std::string>& troubles, const char* key, const fs::path& directory) {
  std::error_code error;
  fs::path folder = fs::absolute(directory, error).lexically_normal();
  while (folder.has_relative_path() && fs::symlink_status(folder, error).type() == fs::file_type::not_found) {
    folder = folder.parent_path();
  }
  const int reason = why_not_writable(folder);
  if (reason == 0) return;
  const std::string where = folder == directory ? "" : " (in " + folder.string() + ")";
  troubles.push_back(std::string(key) + ": " + directory.string() + ": cannot be written" + where + ": " +
                     std::strerror(reason) + "; change its owner or permissions, or name another");
}

}  // namespace

Surroundings this_computer() {
  return {read_target, check_recording, identity, calibrate::read_calibration_file, read_camera_file, check_frames};
}

calibrate::CalibrationFile Surroundings::no_calibration(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

CameraFile Surroundings::no_camera(const std::string& path) {
  throw InputError(path + ": cannot be opened; check the path and its permissions");
}

std::vector<std::string> directory_troubles(const DaemonConfig& config) {
  std::vector<std::string> troubles;
  if (!config.state_directory.empty()) add_trouble(troubles, "state_directory", config.state_directory);
  if (config.recording) add_trouble(troubles, "recording.directory", config.recording->directory);
  return troubles;
}

}  // namespace pharos::host
