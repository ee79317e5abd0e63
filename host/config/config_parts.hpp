// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host/toml/strict_toml.hpp"

namespace pharos::host {

// What several tables of the daemon's configuration are made of. Each throws InputError with file, line and key.

/// Letters, digits and what is in `punctuation`, nothing else.
bool all_of_set(const std::string& text, const char* punctuation);

/// `name`, the value of `key`, if it may be told in messages, log lines and file names.
std::string read_name(const TomlTable& table, std::string_view key, const std::string& name);

/// A path, which starts at `folder` where it is relative.
std::filesystem::path read_path(const TomlTable& table, std::string_view key, const std::filesystem::path& folder);

}  // namespace pharos::host
