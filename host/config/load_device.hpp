// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>

#include "host/config/config_errors.hpp"
#include "host/device/camera_settings.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

// The keys that every table about a GigE Vision camera has. Each function throws InputError with file, line and key.

/// serial and address: at least one is required; `instead` is the advice if there is neither.
void read_which_camera(const TomlTable& table, const char* instead, CameraSettings& device);
/// packet_size and ptp; their errors are added to `errors`.
void read_transport(const TomlTable& table, CameraSettings& device, ConfigErrors& errors);
/// frame_rate_hz; without it the camera's own.
void read_frame_rate(const TomlTable& table, CameraSettings& device);
/// With recorded frames instead of a camera none of `keys` is allowed.
void refuse_beside_frames(const TomlTable& table, std::initializer_list<const char*> keys);

}  // namespace pharos::host
