// SPDX-License-Identifier: Apache-2.0
#include "tools/support/output.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <utility>

#include "host/support/input_error.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command.add_flag("--json", options.json, "One JSON object a line with the same names instead of CSV");
  command.add_option("-o,--output", options.path, "File to write instead of standard output (-)")
      ->check(output_place());
}

void add_pose_format_options(CLI::App& command, OutputOptions& options) {
  command
      .add_option(
          "--format", options.format,
          "csv; json: as --json; tum: lines `time_s x y z qx qy qz qw` of the good poses, the others are counted "
          "on standard error")
      ->check(CLI::IsMember({"csv", "tum", "json"}))
      ->capture_default_str();
  command.add_flag(
      "--covariance", options.covariance,
      "36 further columns cov_rx_rx_rad2 ... cov_tz_tz_m2: the covariance of the pose, row by row, rotation "
      "(rad) before translation (m), of delta in R_true = exp([delta]x) R, t_true = t + delta, in the parent "
      "frame; of an ambiguous pose about the first solution alone");
}

host::RowFormat OutputOptions::row_format() const {
  if (json || format == "json") return host::RowFormat::kJson;
  return format == "tum" ? host::RowFormat::kTum : host::RowFormat::kCsv;
}

void require_place_for_covariance(const OutputOptions& options) {
  if (!options.covariance || options.row_format() != host::RowFormat::kTum) return;
  throw host::InputError("--covariance: a TUM line has no place for it; use --format csv or json");
}

namespace {

std::string& message_prefix() {
  static std::string name = "pharos";
  return name;
}

}  // namespace

Output::Output(const OutputOptions& options, std::vector<std::string> columns) {
  require_place_for_covariance(options);
  std::FILE* stream = stdout;
  if (options.path != "-") stream = file_.emplace(options.path).stream();
  rows_ = std::make_unique<host::RowWriter>(stream, options.row_format(), std::move(columns),
                                            host::RowExtras{options.covariance, options.series});
}

void Output::finish() {
  rows_->flush();
  if (file_) file_->commit();
  note_left_out(rows_->tum());
}

void note_left_out(const host::TumLines& tum) {
  const host::TumLeftOut& left_out = tum.left_out();
  // Where every row is refused, the command itself says that there is no answer.
  if (tum.lines() == 0 && left_out.total() == left_out.refused) return;
  if (left_out.total() > 0) note(text_of(left_out));
}

void set_message_prefix(const std::string& name) { message_prefix() = name; }
void note(const std::string& message) { std::fprintf(stderr, "%s: %s\n", message_prefix().c_str(), message.c_str()); }

}  // namespace pharos::tools
