// SPDX-License-Identifier: Apache-2.0
#include <sstream>
#include <string_view>

#include "tools/manual/completion.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kMaxText = 70;  // of a description, in one line of a list

// Inside '...' of a specification of _arguments, where [ ] and : end a part.
std::string quoted(const std::string& text) {
  std::string out;
  for (const char letter : text.substr(0, text.find_first_of("\n"))) {
    if (out.size() >= kMaxText) break;
    if (letter == '\'') {
      out += "'\\''";
    } else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') {
      out += std::string("\\") + letter;
    } else {
      out += letter;
    }
  }
  return out;
}

std::string action(const OptionDescription& option) {
  return option.choices.empty() ? "_files" : "(" + joined(option.choices, " ") + ")";
}

void write_option(std::ostream& script, const OptionDescription& option) {
  const std::string names = joined(option.names, " ");
  for (const std::string& name : option.names) {
    script << " \\\n    '" << (option.repeated ? "*" : "(" + names + ")") << name << '[' << quoted(option.text) << ']';
    if (!option.value.empty()) script << ':' << quoted(option.value) << ':' << action(option);
    script << '\'';
  }
}

void write_command(std::ostream& script, const CommandDescription& command) {
  for (const CommandDescription& inner : command.commands) write_command(script, inner);
  script << '_' << command.name('_') << "() {\n";
  const bool branches = !command.commands.empty();
  script << "  _arguments" << (branches ? " -C" : " -s");
  for (const OptionDescription& option : command.options) write_option(script, option);
  for (const OptionDescription& argument : command.arguments) {
    script << " \\\n    '" << (argument.repeated ? "*" : "") << ':' << quoted(argument.names.front()) << ':'
           << action(argument) << '\'';
  }
  if (!branches) {
    script << "\n}\n";
    return;
  }
  script << " \\\n    '1: :->command' '*:: :->rest'\n  case $state in\n    command)\n      _values command";
  for (const CommandDescription& inner : command.commands) {
    script << " \\\n        '" << inner.words.back() << '[' << quoted(inner.text) << "]'";
  }
  script << " ;;\n    rest)\n      case $words[1] in\n";
  for (const CommandDescription& inner : command.commands) {
    script << "        " << inner.words.back() << ") _" << inner.name('_') << " ;;\n";
  }
  script << "      esac ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandDescription& program) {
  std::ostringstream script;
  script << "#compdef " << program.words.front() << '\n'
         << "# Made from the program's own definition of its options (tools/manual).\n"
         << "local context state state_descr line\ntypeset -A opt_args\n";
  write_command(script, program);
  script << '_' << program.words.front() << " \"$@\"\n";
  return script.str();
}

}  // namespace pharos::tools
