// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "tools/cli/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app("Relative pose of spacecraft at close range", "pharos");
  app.require_subcommand(1);
  app.set_version_flag("--version", PHAROS_VERSION);
  app.footer("Every subcommand has --help with an example. Exit code: 0 at least one answer, 1 none, 2 wrong usage.");
  int exit_code = pharos::tools::kExitAnswered;
  try {
    pharos::tools::add_commands(app, exit_code);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? pharos::tools::kExitAnswered : pharos::tools::kExitUsage;
  } catch (const std::exception& error) {
    std::cerr << "pharos: " << error.what() << '\n';
    return pharos::tools::kExitUsage;
  }
  return exit_code;
}
