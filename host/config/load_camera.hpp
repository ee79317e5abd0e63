// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/config/strict_toml.hpp"
#include "host/config/surroundings.hpp"

namespace pharos::host {

/// Every [[camera]] of the configuration, with its camera file. Throws InputError naming file, line and key.
std::vector<CameraConfig> read_cameras(const TomlTable& root, const std::filesystem::path& folder,
                                       const Surroundings& surroundings);

}  // namespace pharos::host
