// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace pharos::tools {

/// What the first words of a command line mean.
struct NamedCommand {
  const CLI::App* command = nullptr;  // the innermost command that they name
  std::string name;                   // "pharos", "pharos track", "pharos sim lighthouse"
  std::string unknown;                // the word where a subcommand should stand but another thing does; else empty
};

NamedCommand named_command(const CLI::App& app, std::span<const char* const> words);

/// One line about a command line that cannot be understood: what, where, what to do (without the program's name).
std::string usage_message(const NamedCommand& named, const CLI::ParseError& error);

}  // namespace pharos::tools
