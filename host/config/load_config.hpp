// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host/config/daemon_config.hpp"
#include "host/config/environment.hpp"

namespace pharos::host {

/// Reads and checks the daemon's configuration, the target files, the headers of recordings to be replayed, and that no
/// two targets share a port under any path.
///
/// Throws InputError for everything that is not valid: no key is ignored, no value is clamped. The message has a line
/// with file, line, key and what to do for each error. Ports need not exist: they may be connected later.
DaemonConfig load_daemon_config(const std::filesystem::path& file);

/// The same from text. `name` stands for the file in messages; relative paths start at `folder`.
DaemonConfig parse_daemon_config(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                 const Environment& environment);

/// The configuration as readable text: every setting with its unit, defaults included.
std::string describe(const DaemonConfig& config);

}  // namespace pharos::host
