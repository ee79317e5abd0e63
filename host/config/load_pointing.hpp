// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/config_errors.hpp"
#include "host/config/environment.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Every [[telescope]] of the daemon's configuration. Throws InputError with file, line and key.
/// Their errors are added to `errors`.
std::vector<PointingConfig> read_pointing(const TomlTable& root, const std::filesystem::path& folder,
                                          const Environment& environment, ConfigErrors& errors);

}  // namespace pharos::host
