// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/config/strict_toml.hpp"
#include "host/config/surroundings.hpp"

namespace pharos::host {

/// Every [[stereo]] of the configuration, with its rig file; `cameras` are those of the [[camera]] tables, which no rig
/// may share. Throws InputError naming file, line and key.
std::vector<StereoConfig> read_stereos(const TomlTable& root, const std::filesystem::path& folder,
                                       const Surroundings& surroundings, const std::vector<CameraConfig>& cameras);

}  // namespace pharos::host
