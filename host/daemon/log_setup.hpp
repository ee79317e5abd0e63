// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// Makes spdlog's default logger what the configuration asks for. Throws InputError when the log file cannot be opened.
void set_up_log(const LogConfig& config);

}  // namespace pharos::host
