// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace pharos::tools {

/// `pharos sim …`.
void add_sim(CLI::App& app, int& exit_code);

}  // namespace pharos::tools
