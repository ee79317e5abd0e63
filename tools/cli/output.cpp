// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/output.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::tools {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command.add_flag("--json", options.json, "One JSON object a line with the same names instead of CSV");
  command.add_option("-o,--output", options.path, "File to write instead of standard output (-)");
}

void Output::open(const std::string& path) {
  file_.reset(std::fopen(path.c_str(), "w"));
  if (file_) return;
  throw host::InputError(path_ + ": cannot be written: " + std::strerror(errno) + "; choose another --output");
}

Output::Output(const OutputOptions& options, std::vector<std::string> columns) : path_(options.path) {
  std::error_code error;
  if (path_ == "-") {
    file_.reset(stdout);
  } else if (std::filesystem::exists(path_, error) && !std::filesystem::is_regular_file(path_, error)) {
    open(path_);  // a pipe or a device has no place to be put into
  } else {
    aside_ = path_ + ".new";
    open(aside_);
  }
  rows_ = std::make_unique<host::RowWriter>(file_.get(), options.json ? host::RowFormat::kJson : host::RowFormat::kCsv,
                                            std::move(columns));
}

void Output::finish() {
  rows_->flush();
  if (aside_.empty() || std::rename(aside_.c_str(), path_.c_str()) == 0) return;
  throw host::InputError(path_ + ": cannot be replaced: " + std::strerror(errno) + "; the rows are in " + aside_);
}

void note(const std::string& message) { std::fprintf(stderr, "pharos: %s\n", message.c_str()); }

}  // namespace pharos::tools
