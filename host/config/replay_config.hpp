// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// The configuration with a recorded serial stream as its only source: it stands in for the port of the target that it
/// names, or of the only target. Throws InputError for a file that is no recording, or one of no target of these.
DaemonConfig replay_config(const DaemonConfig& config, const std::string& file);

}  // namespace pharos::host
