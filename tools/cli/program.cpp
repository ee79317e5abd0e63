// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/program.hpp"

#include <CLI/CLI.hpp>

#include "tools/support/commands.hpp"

namespace pharos::tools {

void add_program(CLI::App& app, int& exit_code) {
  app.description("Relative pose of spacecraft at close range");
  app.require_subcommand(1);
  app.set_version_flag("--version", PHAROS_VERSION);
  app.footer("Every subcommand has --help with an example. Exit code: 0 at least one answer, 1 none, 2 wrong usage.");
  add_commands(app, exit_code);
}

}  // namespace pharos::tools
