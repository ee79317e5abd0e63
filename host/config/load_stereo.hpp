// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/config_errors.hpp"
#include "host/config/daemon_config.hpp"
#include "host/config/environment.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Every [[stereo]] of the configuration, with its rig file; `cameras` are those of the [[camera]] tables, which no rig
/// may share. Throws InputError naming file, line and key.
/// Their errors are added to `errors`.
std::vector<StereoConfig> read_stereos(const TomlTable& root, const std::filesystem::path& folder,
                                       const Environment& environment, const std::vector<TofConfig>& cameras,
                                       ConfigErrors& errors);

}  // namespace pharos::host
