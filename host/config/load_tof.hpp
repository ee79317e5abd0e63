// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/config_errors.hpp"
#include "host/config/daemon_config.hpp"
#include "host/config/environment.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Every [[camera]] of the configuration, with its camera file. Throws InputError naming file, line and key.
/// Their errors are added to `errors`.
std::vector<TofConfig> read_tof_cameras(const TomlTable& root, const std::filesystem::path& folder,
                                        const Environment& environment, ConfigErrors& errors);

}  // namespace pharos::host
