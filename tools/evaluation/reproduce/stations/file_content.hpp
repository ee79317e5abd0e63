// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace pharos::tools {

/// A file as it is. Throws host::InputError.
std::string content_of(const std::filesystem::path& path);

}  // namespace pharos::tools
