// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/files/atomic_file.hpp"
#include "host/table/row_writer.hpp"

namespace CLI {
class App;
}

namespace pharos::tools {

// Output of every subcommand that writes a table: destination and format.
struct OutputOptions {
  bool json = false;
  std::string path = "-";
  std::string format = "csv";  // csv, json or tum; --json overrides it
  bool covariance = false;
  std::string series = {};  // with tum: the series to write (host::TumLines); empty: the first

  host::RowFormat row_format() const;
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// --format and --covariance, for tables of poses. What the covariance holds besides is for the command's own help.
void add_pose_format_options(CLI::App& command, OutputOptions& options);

/// Throws InputError for --covariance with a form that has no place for it.
void require_place_for_covariance(const OutputOptions& options);

/// Rows on standard output or in a file, in the format of the options. A failed run leaves the old file
/// (host::AtomicFile).
class Output {
 public:
  /// Throws InputError when the file cannot be written.
  Output(const OutputOptions& options, std::vector<std::string> columns);
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  host::RowWriter& rows() { return *rows_; }
  /// Flushes everything and puts the file in its place; says what has no TUM line. Throws InputError when the disk is
  /// full.
  void finish();

 private:
  std::optional<host::AtomicFile> file_;  // none: standard output
  std::unique_ptr<host::RowWriter> rows_;
};

using host::require_writable;

/// Says on standard error what has no TUM line, unless all is refused.
void note_left_out(const host::TumLines& tum);

/// Sets the name that note() prints: "pharos track". Default: "pharos".
void set_message_prefix(const std::string& name);
/// One line for the user on standard error, after the name of the command.
void note(const std::string& message);

}  // namespace pharos::tools
