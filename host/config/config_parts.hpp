// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host/toml/strict_toml.hpp"

namespace pharos::host {

// Parts that several tables of the daemon's configuration have in common. Each function throws InputError with file,
// line and key.

/// Whether the text has only letters, digits and characters of `punctuation`.
bool all_of_set(const std::string& text, const char* punctuation);

/// `name`, the value of `key`, if it is valid in messages, log lines and file names.
std::string read_name(const TomlTable& table, std::string_view key, const std::string& name);

/// `channel`, the value of `key`, if LCM takes it as a name and not as an expression.
std::string read_channel(const TomlTable& table, std::string_view key, const std::string& channel);

/// A path; relative paths start at `folder`.
std::filesystem::path read_path(const TomlTable& table, std::string_view key, const std::filesystem::path& folder);

}  // namespace pharos::host
