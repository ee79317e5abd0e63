// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "host/config/strict_toml.hpp"
#include "host/config/surroundings.hpp"

namespace pharos::host {

/// Every [[telescope]] of the daemon's configuration. Throws InputError with file, line and key.
std::vector<TelescopeConfig> read_telescopes(const TomlTable& root, const std::filesystem::path& folder,
                                             const Surroundings& surroundings);

}  // namespace pharos::host
