// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"

namespace CLI {
class App;
}

namespace pharos::tools {

// What every subcommand of the table kind shares: where rows go and in which form.
struct OutputOptions {
  bool json = false;
  std::string path = "-";
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// Rows on standard output or in a file, as CSV or JSON lines.
///
/// A file is written beside its place and put there when it is whole: a failed run leaves the old one, and a recording
/// that was named as its own output is read to its end before it is replaced.
class Output {
 public:
  /// Throws InputError when the file cannot be written.
  Output(const OutputOptions& options, std::vector<std::string> columns);

  host::RowWriter& rows() { return *rows_; }
  /// Everything out. Throws InputError when the disk is full.
  void finish();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output();

 private:
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  void open(const std::string& path);

  std::string path_;
  std::string aside_;  // where the file grows; empty where rows go straight to their place
  std::unique_ptr<std::FILE, Close> file_;
  std::unique_ptr<host::RowWriter> rows_;
};

/// Throws InputError when `path` cannot be written, for a table that comes at the end of long work. Changes nothing.
void require_writable(const std::string& path);

/// Who note() speaks as: "pharos track". "pharos" until told.
void set_message_prefix(const std::string& name);
/// One line for people on standard error, after the name of the command.
void note(const std::string& message);

}  // namespace pharos::tools
