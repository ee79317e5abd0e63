// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace pharos::tools {

/// `pharos reproduce line`.
void add_reproduce_pointing(CLI::App& reproduce, int& exit_code);

}  // namespace pharos::tools
