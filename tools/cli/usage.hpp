// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace pharos::tools {

/// The command named by the first words of a command line.
struct NamedCommand {
  const CLI::App* command = nullptr;  // the innermost command that they name
  std::string name;                   // "pharos", "pharos track", "pharos sim lighthouse"
  std::string unknown;                // a word in place of a subcommand that is none; else empty
};

NamedCommand named_command(const CLI::App& app, std::span<const char* const> words);

/// One line about `named.unknown`, with the name that was probably meant.
std::string unknown_command_message(const NamedCommand& named);

/// One line about an invalid command line: what, where, what to do (without the program's name).
std::string usage_message(const NamedCommand& named, const CLI::ParseError& error);

}  // namespace pharos::tools
