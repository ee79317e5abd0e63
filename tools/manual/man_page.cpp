// SPDX-License-Identifier: Apache-2.0
#include "tools/manual/man_page.hpp"

#include <sstream>
#include <string_view>

namespace pharos::tools {
namespace {

std::string upper(std::string text) {
  for (char& letter : text) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return text;
}

std::string bold(const std::string& text) { return "\\fB" + roff_text(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff_text(text) + "\\fR"; }

// Ends a sentence that a definition left without its full stop.
std::string sentence(const std::string& text) {
  if (text.empty()) return "";
  const bool ended = text.ends_with('.') || text.ends_with(':') || text.ends_with('?');
  return text + (ended ? "" : ".");
}

std::string value_of(const OptionDescription& option) {
  if (option.value.empty()) return "";
  return (option.value.front() == '[' ? option.value : upper(option.value)) + (option.repeated ? "..." : "");
}

void write_option(std::ostream& page, const OptionDescription& option, bool is_argument) {
  page << ".TP\n";
  if (is_argument) {
    page << italic(option.names.front()) << (option.repeated ? "..." : "") << '\n';
  } else {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    page << names;
    if (const std::string value = value_of(option); !value.empty()) page << ' ' << italic(value);
    page << '\n';
  }
  page << roff_text(sentence(option.text.empty() ? std::string("No description") : option.text)) << '\n';
  if (!option.choices.empty()) page << roff_text("One of: " + joined(option.choices, ", ") + ".") << '\n';
  if (!option.limits.empty()) page << roff_text("Value: " + option.limits + ".") << '\n';
  if (!option.initial.empty()) page << roff_text("Default: " + option.initial + ".") << '\n';
  if (option.required && !is_argument) page << "Required.\n";
}

void write_synopsis(std::ostream& page, const CommandDescription& command) {
  page << ".SH SYNOPSIS\n" << bold(command.name(' ')) << '\n';
  for (const OptionDescription& option : command.options) {
    if (option.required) page << bold(option.names.back()) << ' ' << italic(value_of(option)) << '\n';
  }
  if (!command.options.empty()) page << '[' << italic("OPTIONS") << "]\n";
  for (const OptionDescription& argument : command.arguments) {
    const std::string name = italic(argument.names.front()) + (argument.repeated ? "..." : "");
    page << (argument.required ? name : "[" + name + "]") << '\n';
  }
  if (!command.commands.empty()) page << italic("COMMAND") << '\n';
}

// A footer has examples, indented by two spaces, and sentences that go on over line ends.
void write_footer(std::ostream& page, const std::string& footer) {
  if (footer.empty()) return;
  page << ".SH EXAMPLES AND NOTES\n";
  std::istringstream lines(footer);
  bool in_example = false;
  for (std::string line; std::getline(lines, line);) {
    const bool example = line.starts_with("  ");
    if (example != in_example) page << (example ? ".PP\n.nf\n" : ".fi\n.PP\n");
    in_example = example;
    if (line.empty()) {
      page << (example ? "" : ".PP\n");
    } else {
      page << roff_text(line) << '\n';
    }
  }
  if (in_example) page << ".fi\n";
}

void write_commands(std::ostream& page, const CommandDescription& command, int section) {
  if (command.commands.empty()) return;
  page << ".SH COMMANDS\n";
  for (const CommandDescription& inner : command.commands) {
    page << ".TP\n" << bold(inner.name('-')) << '(' << section << ")\n" << roff_text(sentence(inner.text)) << '\n';
  }
}

// In the line of NAME a '-' separates the name from what it is, and it is one line.
std::string one_line(std::string text) {
  for (char& letter : text) {
    if (letter == '\n') letter = ' ';
  }
  while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
  return text;
}

void write_see_also(std::ostream& page, const CommandDescription& command, const PageFrame& frame) {
  std::vector<std::string> pages;
  if (command.words.size() > 1) {
    CommandDescription above = command;
    above.words.pop_back();
    pages.push_back(above.name('-') + "(" + std::to_string(frame.section) + ")");
  }
  pages.insert(pages.end(), frame.see_also.begin(), frame.see_also.end());
  if (pages.empty()) return;
  page << ".SH SEE ALSO\n" << roff_text(joined(pages, ", ")) << '\n';
}

}  // namespace

std::string roff_text(const std::string& text) {
  std::string roff;
  bool line_start = true;
  char before = ' ';
  for (const char letter : text) {
    if (before == ',' && letter != ' ' && letter != '\n') roff += "\\:";  // lists of columns are longer than a line
    before = letter;
    if (line_start && (letter == '.' || letter == '\'')) roff += "\\&";
    line_start = letter == '\n';
    switch (letter) {
      case '\\':
        roff += "\\(rs";
        break;
      case '-':
        roff += "\\-";
        break;
      case '\'':
        roff += "\\(aq";
        break;
      case '`':
        roff += "\\(ga";
        break;
      case '^':
        roff += "\\(ha";
        break;
      case '~':
        roff += "\\(ti";
        break;
      default:
        roff += letter;
    }
  }
  return roff;
}

std::string man_page(const CommandDescription& command, const PageFrame& frame) {
  std::ostringstream page;
  page << ".\\\" Made from the program's own definition of its options (tools/manual).\n"
       << ".TH " << upper(command.name('-')) << ' ' << frame.section << " \"\" \"Pharos " << frame.version
       << "\" \"Pharos\"\n"
       << ".ad l\n.nh\n"
       << ".SH NAME\n"
       << roff_text(command.name('-')) << " \\- " << roff_text(one_line(command.text)) << '\n';
  write_synopsis(page, command);
  page << ".SH DESCRIPTION\n" << roff_text(sentence(command.text)) << '\n';
  if (!command.arguments.empty()) page << ".SH ARGUMENTS\n";
  for (const OptionDescription& argument : command.arguments) write_option(page, argument, true);
  if (!command.options.empty()) page << ".SH OPTIONS\n";
  for (const OptionDescription& option : command.options) write_option(page, option, false);
  write_commands(page, command, frame.section);
  write_footer(page, command.footer);
  if (!frame.exit_status.empty()) page << ".SH EXIT STATUS\n" << roff_text(frame.exit_status) << '\n';
  write_see_also(page, command, frame);
  return page.str();
}

}  // namespace pharos::tools
