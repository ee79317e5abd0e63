// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "host/cameras/calibration_record.hpp"
#include "pharos/camera/pinhole_camera.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::host {

/// One camera of a rig: its optics and its pose in the rig's frame, as written in the file.
struct RigCamera {
  PinholeCamera intrinsics;
  std::array<double, 4> rotation_wxyz{1.0, 0.0, 0.0, 0.0};  // length 1 within 1e-3
  std::array<double, 3> position_m{};

  /// T_rig_camera, with an exactly orthonormal rotation.
  Pose<frame::Rig, frame::Camera> pose() const;
};

/// Two cameras fixed to each other.
struct RigFile {
  RigCamera left;
  RigCamera right;
  std::optional<CalibrationRecord> calibration;
};

/// Reads a rig file (`-`: standard input). Throws InputError naming file, line and key; also for an invalid rotation
/// and for two cameras at the same position.
RigFile read_rig_file(const std::string& path);

/// The same from text; `name` stands for the file in messages.
RigFile parse_rig(std::string_view text, const std::string& name);

/// The file's text; parse_rig reads the same values from it.
std::string rig_text(const RigFile& file);

}  // namespace pharos::host
