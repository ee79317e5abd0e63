// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/config/config_errors.hpp"
#include "host/config/daemon_config.hpp"
#include "host/toml/strict_toml.hpp"

namespace pharos::host {

/// Every [[remote]]. `config`: of the daemon, with its name, [lcm] and all its other sources.
std::vector<RemoteConfig> read_remotes(const TomlTable& root, const DaemonConfig& config, ConfigErrors& errors);

}  // namespace pharos::host
