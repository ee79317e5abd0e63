// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// The configuration with a recorded serial stream as its only source. It replaces the port of the target named in it,
/// or of the only target. Throws InputError for a file that is not a recording, or that belongs to none of these
/// targets.
DaemonConfig replay_config(const DaemonConfig& config, const std::string& file);

}  // namespace pharos::host
