// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "host/config/load_config.hpp"
#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {

inline TargetFile any_target(const std::string&) {
  TargetFile file;
  file.shape.sensors = 12;
  return file;
}

/// A rig of 640 x 480 pixels; cannot be opened if the name contains "gone".
inline RigFile a_rig(const std::string& path) {
  if (path.find("gone") != std::string::npos) throw InputError(path + ": cannot be opened");
  RigFile rig;
  for (RigCamera* camera : {&rig.left, &rig.right}) {
    camera->intrinsics.width_px = 640;
    camera->intrinsics.height_px = 480;
  }
  return rig;
}

/// An environment without a disk. Names that contain "gone" do not exist, all others do; /dev/left and /dev/right are
/// one device. A camera file has 640 x 480 pixels, or 1280 x 480 if its name contains "large".
inline Environment made_up() {
  return {any_target,
          [](const std::filesystem::path& file) {
            if (file.filename() == "gone") throw InputError(file.string() + ": cannot be opened");
          },
          [](const std::string& path) { return path == "/dev/left" || path == "/dev/right" ? "one" : path; },
          [](const std::string& path) {
            calibrate::CalibrationFile file;
            file.name = path;
            return file;
          },
          [](const std::string& path) {
            if (path.find("gone") != std::string::npos) throw InputError(path + ": cannot be opened");
            CameraFile file;
            file.camera.intrinsics.width_px = path.find("large") != std::string::npos ? 1280 : 640;
            file.camera.intrinsics.height_px = 480;
            return file;
          },
          [](const std::filesystem::path& directory) {
            if (directory.filename() == "gone") throw InputError(directory.string() + ": holds no frames");
          },
          a_rig};
}

inline DaemonConfig parse(const std::string& text) {
  return parse_daemon_config(text, "p.toml", "/etc/pharos", made_up());
}

inline std::string error_of(const std::string& text) {
  return pharos::test::error_of([&] { parse(text); });
}

}  // namespace pharos::host
