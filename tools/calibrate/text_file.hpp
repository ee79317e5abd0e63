// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pharos::tools {

/// Writes a calibration so that it survives a power cut; `-` is standard output. Throws InputError when it cannot be
/// written.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace pharos::tools
