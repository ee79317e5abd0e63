// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace pharos::tools {

/// One option or argument of a command.
struct OptionDescription {
  std::vector<std::string> names;    // "-o", "--output"; of an argument its one name, "EDGES"
  std::string value;                 // what it takes: "FILE", "FLOAT"; empty for a flag
  std::string limits;                // of the value, as its check says: "INT in [0 - 100]"
  std::vector<std::string> choices;  // the only values, if there are few
  std::string initial;               // the default; empty: none, or the text says it
  std::string text;
  bool required = false;
  bool repeated = false;
};

/// One command of a program, as its CLI11 definition says.
struct CommandDescription {
  std::vector<std::string> words;  // "pharos", "sim", "lighthouse"
  std::string text;
  std::string footer;  // example and notes
  std::vector<OptionDescription> arguments;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;

  /// The words, joined: by ' ' as typed, by '-' as the page's name.
  std::string name(char between) const;
};

/// The words with `between` between them.
std::string joined(const std::vector<std::string>& words, const char* between);

/// `app` and its subcommands, without what is hidden from --help.
CommandDescription describe(const CLI::App& app);

}  // namespace pharos::tools
