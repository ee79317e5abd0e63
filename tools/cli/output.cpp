// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/output.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::tools {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command.add_flag("--json", options.json, "One JSON object a line with the same names instead of CSV");
  command.add_option("-o,--output", options.path, "File to write instead of standard output (-)");
}

Output::Output(const OutputOptions& options, std::vector<std::string> columns) {
  file_.reset(options.path == "-" ? stdout : std::fopen(options.path.c_str(), "w"));
  if (!file_) {
    throw host::InputError(options.path + ": cannot be written: " + std::strerror(errno) + "; choose another --output");
  }
  rows_ = std::make_unique<host::RowWriter>(file_.get(), options.json ? host::RowFormat::kJson : host::RowFormat::kCsv,
                                            std::move(columns));
}

void note(const std::string& message) { std::fprintf(stderr, "pharos: %s\n", message.c_str()); }

}  // namespace pharos::tools
