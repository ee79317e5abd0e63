// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "host/cameras/calibration_record.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/camera/pinhole_camera.hpp"

// Reading and writing of the parts that camera files and rig files have in common.
namespace pharos::host {

PinholeCamera read_intrinsics(const TomlTable& table);
std::string intrinsics_text(const PinholeCamera& intrinsics);

/// [calibration], where there is one.
std::optional<CalibrationRecord> read_record(const TomlTable& root);
std::string record_text(const CalibrationRecord& record);

}  // namespace pharos::host
