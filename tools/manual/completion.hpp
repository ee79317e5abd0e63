// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/manual/description.hpp"

namespace pharos::tools {

/// A completion script for bash: subcommands, options, and the values of options that have only a few; elsewhere files.
/// Needs no other package than bash.
std::string bash_completion(const CommandDescription& program);

/// The same for zsh, with the descriptions; to be named _PROGRAM in a folder of $fpath.
std::string zsh_completion(const CommandDescription& program);

}  // namespace pharos::tools
