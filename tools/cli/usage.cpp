// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/usage.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "host/support/nearest_name.hpp"

namespace pharos::tools {
namespace {

const CLI::App* subcommand(const CLI::App& command, std::string_view word) {
  for (const CLI::App* candidate : command.get_subcommands({})) {
    if (candidate->get_name() == word) return candidate;
  }
  return nullptr;
}

std::vector<std::string> subcommand_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* candidate : command.get_subcommands({})) names.push_back(candidate->get_name());
  return names;
}

std::string help_of(const NamedCommand& named) { return "; `" + named.name + " --help` says how"; }

}  // namespace

NamedCommand named_command(const CLI::App& app, std::span<const char* const> words) {
  NamedCommand named{&app, app.get_name(), ""};
  for (const std::string_view word : words) {
    if (named.command->get_subcommands({}).empty()) break;
    const CLI::App* next = subcommand(*named.command, word);
    if (next == nullptr) {
      named.unknown = word;
      break;
    }
    named.command = next;
    named.name += " " + next->get_name();
  }
  return named;
}

std::string unknown_command_message(const NamedCommand& named) {
  const std::vector<std::string> names = subcommand_names(*named.command);
  const bool option = named.unknown.starts_with('-');
  const std::string meant = option ? "" : nearest_name(named.unknown, names);
  return (option ? "unknown option '" : "unknown command '") + named.unknown + "'" +
         (meant.empty() ? "" : ", did you mean '" + meant + "'?") + "; the commands are " +
         CLI::detail::join(names, ", ") + help_of(named);
}

std::string usage_message(const NamedCommand& named, const CLI::ParseError& error) {
  if (!named.unknown.empty()) return unknown_command_message(named);
  const std::string help = help_of(named);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !named.command->get_subcommands({}).empty()) {
    return "no command given; the commands are " + CLI::detail::join(subcommand_names(*named.command), ", ") + help;
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const std::string text = error.what();
    return text.substr(0, text.find(':')) + ": its value is missing" + help;
  }
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return what + help;
}

}  // namespace pharos::tools
