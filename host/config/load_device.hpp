// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>

#include "host/config/config_errors.hpp"
#include "host/device/camera_settings.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

// What every table about a GigE Vision camera holds. What is wrong goes to `errors`, or is thrown, as InputError with
// file, line and key.

/// serial and address: of which at least one must be there; `instead` says what to give where there is neither.
void read_which_camera(const TomlTable& table, const char* instead, CameraSettings& device, ConfigErrors& errors);
/// packet_size and ptp.
void read_transport(const TomlTable& table, CameraSettings& device, ConfigErrors& errors);
/// frame_rate_hz; without it the camera's own.
void read_frame_rate(const TomlTable& table, CameraSettings& device);
/// Recorded frames stand in for a camera: none of `keys` may be there.
void refuse_beside_frames(const TomlTable& table, std::initializer_list<const char*> keys, ConfigErrors& errors);

}  // namespace pharos::host
