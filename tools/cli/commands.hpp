// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace pharos::tools {

// Every subcommand adds itself to `app` with its options, help and example; its callback writes the program's exit code:
// 0 at least one answer, 1 none could be had. Wrong usage and unreadable input are thrown as host::InputError (exit 2).

inline void add_commands(CLI::App& app, int& exit_code) {
  (void)app;
  (void)exit_code;
}

}  // namespace pharos::tools
