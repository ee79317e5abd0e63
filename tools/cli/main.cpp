// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "tools/cli/commands.hpp"

namespace {

constexpr int kExitUsage = 2;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Relative pose of spacecraft at close range", "pharos");
  app.require_subcommand(1);
  app.set_version_flag("--version", PHAROS_VERSION);
  int exit_code = 0;
  pharos::tools::add_commands(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  } catch (const std::exception& error) {
    std::cerr << "pharos: " << error.what() << '\n';
    return kExitUsage;
  }
  return exit_code;
}
