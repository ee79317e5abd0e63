// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host/config/daemon_config.hpp"
#include "host/config/environment.hpp"

namespace pharos::host {

/// Reads and checks the daemon's configuration, and with it the target files, the heads of recordings to be replayed
/// and that no two targets share a port, however it is spelt.
///
/// Throws InputError for anything that is not understood completely: no key is ignored, no value is bent into range.
/// Its message has a line with file, line, key and what to do for each part that is wrong (each table, each target,
/// each kind of source). Ports need not exist: they may be plugged in later.
DaemonConfig load_daemon_config(const std::filesystem::path& file);

/// The same from text. `name` stands for the file in messages; relative paths start at `folder`.
DaemonConfig parse_daemon_config(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                 const Environment& environment);

/// What was understood, for people: every setting with its unit, defaults included.
std::string describe(const DaemonConfig& config);

}  // namespace pharos::host
