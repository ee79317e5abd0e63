// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <sstream>

#include "tools/manual/completion.hpp"

namespace pharos::tools {
namespace {

using Writer = std::function<void(std::ostream&, const CommandDescription&)>;

void for_each_command(std::ostream& script, const CommandDescription& command, const Writer& write) {
  write(script, command);
  for (const CommandDescription& inner : command.commands) for_each_command(script, inner, write);
}

// A function that prints the words of one kind that fit a command, or a command and its option.
void write_function(std::ostream& script, const CommandDescription& program, const std::string& name,
                    const Writer& write) {
  script << name << "() {\n  case \"$1\" in\n";
  for_each_command(script, program, write);
  script << "    *) return 1 ;;\n  esac\n}\n";
}

void list_commands(std::ostream& script, const CommandDescription& command) {
  std::vector<std::string> names;
  for (const CommandDescription& inner : command.commands) names.push_back(inner.words.back());
  if (!names.empty()) script << "    \"" << command.name(' ') << "\") echo \"" << joined(names, " ") << "\" ;;\n";
}

void list_options(std::ostream& script, const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  script << "    \"" << command.name(' ') << "\") echo \"" << joined(names, " ") << "\" ;;\n";
}

// Of options that take a value: its choices, or nothing where any file may be meant. Of a flag there is no row.
void list_values(std::ostream& script, const CommandDescription& command) {
  for (const OptionDescription& option : command.options) {
    if (option.value.empty()) continue;
    script << "    ";
    for (const std::string& name : option.names) {
      script << (name == option.names.front() ? "" : "|") << '"' << command.name(' ') << ' ' << name << '"';
    }
    script << ") echo \"" << joined(option.choices, " ") << "\" ;;\n";
  }
}

// Of arguments with few values, such as the kind of a benchmark.
void list_arguments(std::ostream& script, const CommandDescription& command) {
  std::vector<std::string> values;
  for (const OptionDescription& argument : command.arguments) {
    values.insert(values.end(), argument.choices.begin(), argument.choices.end());
  }
  if (!values.empty()) script << "    \"" << command.name(' ') << "\") echo \"" << joined(values, " ") << "\" ;;\n";
}

constexpr const char* kComplete = R"sh(
_@_complete() {
  local command=@ current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words i
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ " $(_@_commands "$command") " == *" ${COMP_WORDS[i]} "* ]] && command+=" ${COMP_WORDS[i]}"
  done
  COMPREPLY=()
  if [[ $previous == -* ]] && words=$(_@_values "$command $previous"); then
    :
  elif [[ $current == -* ]]; then
    words=$(_@_options "$command")
  else
    words=$(_@_commands "$command" || _@_arguments "$command")
  fi
  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -o default -F _@_complete @
)sh";

}  // namespace

std::string bash_completion(const CommandDescription& program) {
  const std::string& name = program.words.front();
  std::ostringstream script;
  script << "# Made from the program's own definition of its options (tools/manual).\n";
  write_function(script, program, "_" + name + "_commands", list_commands);
  write_function(script, program, "_" + name + "_options", list_options);
  write_function(script, program, "_" + name + "_values", list_values);
  write_function(script, program, "_" + name + "_arguments", list_arguments);
  for (const char* letter = kComplete; *letter != '\0'; ++letter) {
    *letter == '@' ? script << name : script << *letter;
  }
  return script.str();
}

}  // namespace pharos::tools
