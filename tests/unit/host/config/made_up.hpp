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

/// A ring of 0.56 m across and `connectors` of them; a file that is gone cannot be opened.
inline DockingTarget a_docking_target(const std::string& path, std::size_t connectors) {
  if (path.find("gone") != std::string::npos) throw InputError(path + ": cannot be opened");
  DockingTarget target;
  target.outer_radius = {0.28, 0.001};
  target.inner_radius = {0.265, 0.001};
  for (std::size_t k = 0; k < connectors; ++k) {
    target.connectors.push_back(
        {{0.3 + 0.1 * static_cast<double>(k), 0.001}, {0.0, 0.001}, {0.06, 0.001}, {0.08, 0.08}});
  }
  return target;
}

/// One source, `tof`, at the origin of the vehicle.
inline Mounting a_mounting(const std::string& path) {
  if (path.find("gone") != std::string::npos) throw InputError(path + ": cannot be opened");
  SourceMounting tof;
  tof.name = "tof";
  tof.kind = SourceKind::kTof;
  tof.T_vehicle_sensor.origin = MountingOrigin::kGiven;
  tof.T_target_feature.emplace();
  tof.T_target_feature->origin = MountingOrigin::kGiven;
  return {"", {tof}};
}

/// An environment without a disk. Names that contain "gone" do not exist, all others do; /dev/left and /dev/right are
/// one device. A camera file has 640 x 480 pixels, or 1280 x 480 if its name contains "large". A docking target has
/// two connectors, or nine if its name contains "many". What [recording] made of a camera or a rig is called
/// "recorded".
inline Environment made_up() {
  Environment environment{
      any_target,
      [](const std::filesystem::path& file, const std::string&) {
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
      [](const std::filesystem::path& directory, const std::string&) {
        if (directory.filename() == "gone") throw InputError(directory.string() + ": holds no frames");
        return directory.filename() == "recorded";
      },
      a_rig,
      [](const RigFile&) {},
      [](const RigFile&, const std::string&) {},
      [](const std::string&) {},
      [](const std::filesystem::path& directory, const RigFile&, const std::string&) {
        return directory.filename() == "recorded";
      },
      [](const std::string& path) { return a_docking_target(path, path.find("many") != std::string::npos ? 9 : 2); }};
  environment.read_mounting = a_mounting;
  return environment;
}

inline DaemonConfig parse(const std::string& text) {
  return parse_daemon_config(text, "p.toml", "/etc/pharos", made_up());
}

inline std::string error_of(const std::string& text) {
  return pharos::test::error_of([&] { parse(text); });
}

}  // namespace pharos::host
