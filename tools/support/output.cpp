// SPDX-License-Identifier: Apache-2.0
#include "tools/support/output.hpp"

#include <CLI/CLI.hpp>
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

namespace {

std::string& message_prefix() {
  static std::string name = "pharos";
  return name;
}

// A pipe or a device cannot be replaced by renaming.
bool is_replaceable(const std::string& path) {
  std::error_code error;
  return !std::filesystem::exists(path, error) || std::filesystem::is_regular_file(path, error);
}

std::string beside(const std::string& path) { return path + ".new"; }

[[noreturn]] void refuse(const std::string& path) {
  throw host::InputError(path + ": cannot be written: " + std::strerror(errno) + "; choose another file");
}

}  // namespace

void Output::open(const std::string& path) {
  file_.reset(std::fopen(path.c_str(), "w"));
  if (!file_) refuse(path_);
}

Output::Output(const OutputOptions& options, std::vector<std::string> columns) : path_(options.path) {
  if (path_ == "-") {
    file_.reset(stdout);
  } else if (is_replaceable(path_)) {
    aside_ = beside(path_);
    open(aside_);
  } else {
    open(path_);
  }
  rows_ = std::make_unique<host::RowWriter>(file_.get(), options.json ? host::RowFormat::kJson : host::RowFormat::kCsv,
                                            std::move(columns));
}

void Output::finish() {
  rows_->flush();
  const std::string aside = std::exchange(aside_, {});
  if (aside.empty() || std::rename(aside.c_str(), path_.c_str()) == 0) return;
  throw host::InputError(path_ + ": cannot be replaced: " + std::strerror(errno) + "; the rows are in " + aside);
}

Output::~Output() {
  if (!aside_.empty()) std::remove(aside_.c_str());
}

void require_writable(const std::string& path) {
  if (path == "-" || !is_replaceable(path)) return;
  const std::string aside = beside(path);
  std::FILE* file = std::fopen(aside.c_str(), "w");
  if (file == nullptr) refuse(path);
  std::fclose(file);
  std::remove(aside.c_str());
}

void set_message_prefix(const std::string& name) { message_prefix() = name; }
void note(const std::string& message) { std::fprintf(stderr, "%s: %s\n", message_prefix().c_str(), message.c_str()); }

}  // namespace pharos::tools
