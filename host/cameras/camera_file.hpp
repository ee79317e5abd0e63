// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/cameras/calibration_record.hpp"
#include "pharos/camera/depth_camera.hpp"

namespace pharos::host {

/// Contents of a camera file (README.md shows one).
struct CameraFile {
  DepthCamera camera;  // depth keys absent from the file have their defaults
  std::optional<CalibrationRecord> calibration;
};

/// Reads a camera file (`-`: standard input). Throws InputError naming file, line and key.
CameraFile read_camera_file(const std::string& path);

/// The same from text; `name` stands for the file in messages.
CameraFile parse_camera(std::string_view text, const std::string& name);

/// The file's text; parse_camera reads the same values from it.
std::string camera_text(const CameraFile& file);

}  // namespace pharos::host
