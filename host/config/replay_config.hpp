// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// The configuration with recordings as its only sources. `path`: a recorded serial stream, which replaces the port of
/// the target named in it, or of the only target; or a directory, as [recording] fills it, of which every target,
/// camera and rig plays its own files. Throws InputError for what is no recording, or belongs to none of these sources.
DaemonConfig replay_config(const DaemonConfig& config, const std::string& path);

}  // namespace pharos::host
