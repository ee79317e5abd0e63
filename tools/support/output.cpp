// SPDX-License-Identifier: Apache-2.0
#include "tools/support/output.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <utility>

#include "tools/support/output_place.hpp"

namespace pharos::tools {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command.add_flag("--json", options.json, "One JSON object a line with the same names instead of CSV");
  command.add_option("-o,--output", options.path, "File to write instead of standard output (-)")
      ->check(output_place());
}

namespace {

std::string& message_prefix() {
  static std::string name = "pharos";
  return name;
}

}  // namespace

Output::Output(const OutputOptions& options, std::vector<std::string> columns) {
  std::FILE* stream = stdout;
  if (options.path != "-") stream = file_.emplace(options.path).stream();
  rows_ = std::make_unique<host::RowWriter>(stream, options.json ? host::RowFormat::kJson : host::RowFormat::kCsv,
                                            std::move(columns));
}

void Output::finish() {
  rows_->flush();
  if (file_) file_->commit();
}

void set_message_prefix(const std::string& name) { message_prefix() = name; }
void note(const std::string& message) { std::fprintf(stderr, "%s: %s\n", message_prefix().c_str(), message.c_str()); }

}  // namespace pharos::tools
