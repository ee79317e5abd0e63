// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::tools {

/// Writes a file under a temporary name and renames it when it is complete; `-` is standard output. Throws InputError
/// when it cannot be written.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace pharos::tools
