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

// Output of every subcommand that writes a table: destination and format.
struct OutputOptions {
  bool json = false;
  std::string path = "-";
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// Rows on standard output or in a file, as CSV or JSON lines.
///
/// A file is written under a temporary name in the same folder and renamed when it is complete: a failed run leaves the
/// old one, and a recording that is also the output is read to its end before it is replaced.
class Output {
 public:
  /// Throws InputError when the file cannot be written.
  Output(const OutputOptions& options, std::vector<std::string> columns);

  host::RowWriter& rows() { return *rows_; }
  /// Flushes everything and renames the file. Throws InputError when the disk is full.
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
  std::string aside_;  // temporary name; empty where rows are written directly
  std::unique_ptr<std::FILE, Close> file_;
  std::unique_ptr<host::RowWriter> rows_;
};

/// Throws InputError when `path` cannot be written, for a table that is written at the end of long work. Changes
/// nothing.
void require_writable(const std::string& path);

/// Sets the name that note() prints: "pharos track". Default: "pharos".
void set_message_prefix(const std::string& name);
/// One line for the user on standard error, after the name of the command.
void note(const std::string& message);

}  // namespace pharos::tools
