// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// What the daemon will do, as lines of one table with a header: each source under the name that its messages have,
/// what it observes, where its data come from, what it measures and on which channel.
std::vector<std::string> source_table(const DaemonConfig& config);

}  // namespace pharos::host
