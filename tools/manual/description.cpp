// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/description.hpp"

#include <CLI/CLI.hpp>
#include <string_view>

namespace pharos::tools {
namespace {

// CLI11 joins the value's type and the descriptions of its checks: "TEXT:{a,b}", "INT:INT in [1 - 9]", "TEXT:FILE".
void read_type(const std::string& type_name, OptionDescription& option) {
  const std::size_t colon = type_name.find(':');
  option.value = type_name.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string check = type_name.substr(colon + 1);
  if (check.size() > 1 && check.front() == '{' && check.back() == '}') {
    option.choices = CLI::detail::split(check.substr(1, check.size() - 2), ',');
  } else {
    option.limits = check;
  }
}

OptionDescription describe(const CLI::Option& option) {
  OptionDescription description;
  if (option.get_positional()) {
    description.names.push_back(option.get_name(true, false));
  } else {
    for (const std::string& name : option.get_snames()) description.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) description.names.push_back("--" + name);
  }
  if (option.get_type_size() != 0) {
    read_type(option.get_type_name(), description);
    description.initial = option.get_default_str();
  }
  description.text = option.get_description();
  description.required = option.get_required();
  description.repeated = option.get_expected_max() > 1;
  return description;
}

CommandDescription describe(const CLI::App& app, std::vector<std::string> words) {
  CommandDescription command;
  command.words = std::move(words);
  command.text = app.get_description();
  command.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? command.arguments : command.options).push_back(describe(*option));
  }
  for (const CLI::App* inner : app.get_subcommands({})) {
    if (inner->get_group().empty()) continue;
    std::vector<std::string> inner_words = command.words;
    inner_words.push_back(inner->get_name());
    command.commands.push_back(describe(*inner, std::move(inner_words)));
  }
  return command;
}

}  // namespace

std::string joined(const std::vector<std::string>& words, const char* between) {
  return CLI::detail::join(words, between);
}

std::string CommandDescription::name(char between) const { return CLI::detail::join(words, std::string(1, between)); }

CommandDescription describe(const CLI::App& app) { return describe(app, {app.get_name()}); }

}  // namespace pharos::tools
