// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "host/config/config_errors.hpp"
#include "host/config/daemon_config.hpp"
#include "host/config/environment.hpp"

namespace pharos::host {

/// The [vehicle] table, if there is one, with its mounting file. `configured`: all sources of the configuration.
///
/// A source of the mounting file is the configured one that it is named after: NAME, or KIND-NAME, or KIND alone where
/// only one of that kind observes the target (kinds: lighthouse, tof, ring2, slam).
std::optional<VehicleConfig> read_vehicle(const TomlTable& root, const std::filesystem::path& folder,
                                          const Environment& environment, const SourceConfigs& configured,
                                          ConfigErrors& errors);

}  // namespace pharos::host
