// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>

#include "tools/cli/program.hpp"
#include "tools/cli/usage.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"

namespace {

// Every command alike, before it opens anything.
void refuse_lost_inputs(CLI::App& command) {
  for (CLI::App* inner : command.get_subcommands({})) refuse_lost_inputs(*inner);
  command.parse_complete_callback([&command] { pharos::tools::refuse_output_onto_input(command); });
}

}  // namespace

int main(int argc, char** argv) {
  using namespace pharos::tools;
  CLI::App app("", "pharos");
  int exit_code = kExitAnswered;
  add_program(app, exit_code);
  refuse_lost_inputs(app);
  const NamedCommand named = named_command(app, {argv + std::min(argc, 1), argv + argc});
  set_message_prefix(named.name);
  if (!named.unknown.empty() && !named.unknown.starts_with('-')) {  // also before --help, which would answer with 0
    note(unknown_command_message(named));
    return kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    note(usage_message(named, error));
    return kExitUsage;
  } catch (const std::exception& error) {
    note(error.what());
    return kExitUsage;
  }
  return exit_code;
}
