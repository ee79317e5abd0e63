// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pharos::tools {

/// For ->check(): a file for a picture of the kind `suffix` (".svg", ".png"), the only one that the command writes; a
/// name that ends as another kind of picture does is refused.
CLI::Validator picture_kind(const std::string& suffix);

}  // namespace pharos::tools
