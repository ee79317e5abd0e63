// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "host/mounting/mounting.hpp"

namespace pharos::host {

/// Reads mounting.toml (README.md shows one; `-` is standard input). Throws InputError "file:line: key: reason": not
/// finite, a quaternion that is none, a covariance that is none, a position beyond 1 km, a name twice, no source, more
/// than 16, an unknown key.
Mounting read_mounting_file(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Mounting parse_mounting(std::string_view text, const std::string& name);

/// The file's text; parse_mounting reads the same values from it, bit by bit.
std::string mounting_text(const Mounting& mounting);

/// Writes the file, which takes its place when it is complete. Throws InputError.
void write_mounting_file(const std::string& path, const Mounting& mounting);

}  // namespace pharos::host
