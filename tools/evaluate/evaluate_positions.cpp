// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/evaluate_positions.hpp"

#include <CLI/CLI.hpp>

#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluate/position_comparison.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"

namespace pharos::tools {
namespace {

const std::vector<std::string> kPositionColumns = {
    "align",      "time_offset_s",   "clock_rate",       "rows",          "compared",   "refused",
    "epochs",     "epochs_answered", "pos_mean_mm",      "pos_median_mm", "pos_rms_mm", "pos_p95_mm",
    "pos_max_mm", "spread_pos_mm",   "pos_nees_per_dof", "lever_x_m",     "lever_y_m",  "lever_z_m",
    "world_qw",   "world_qx",        "world_qy",         "world_qz",      "world_tx_m", "world_ty_m",
    "world_tz_m", "status"};

std::vector<double> times_of(const std::string& path) {
  host::TableReader table(host::ByteSource(path), {"time_s"});
  std::vector<double> times;
  while (table.next()) times.push_back(table.number(0));
  return times;
}

void write_row(host::RowWriter& rows, const evaluate::PositionTrack& estimate, const evaluate::PositionComparison& c) {
  const bool answered = c.refused.empty();
  const auto number = [&](double value) { answered ? rows.number(value) : rows.none(); };
  const auto count = [&](std::size_t value) { rows.integer(static_cast<std::int64_t>(value)); };
  rows.text(c.stationary ? "mean" : "se3");
  number(c.offset_s);
  number(c.rate);
  count(estimate.rows);
  count(c.compared);
  count(estimate.refused);
  count(c.epochs);
  count(c.epochs_answered);
  for (const double value : {c.mean_m, c.median_m, c.rms_m, c.p95_m, c.max_m, c.spread_m}) number(value * kMmPerM);
  rows.number(answered ? c.nees_per_dof : std::nullopt);
  for (int k = 0; k < 3; ++k) number(c.lever_m[k]);
  const Quaternion q = canonical_quaternion(c.R_estimate_truth);
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) number(value);
  for (int k = 0; k < 3; ++k) number(c.t_estimate_truth_m[k]);
  rows.text(answered ? "ok" : c.refused).end_row();
}

}  // namespace

void add_position_options(CLI::App& command, PositionChoices& choices) {
  command
      .add_option("--clock-marks", choices.clock_marks,
                  "TRUTH of positions: FIRST,LAST: times on ESTIMATE's clock of TRUTH's first and last row; default: "
                  "found from the motion")
      ->delimiter(',')
      ->expected(2);
  command
      .add_option("--clock-window-ms", choices.clock_window_ms,
                  "TRUTH of positions: how far both ends of the clock are searched around")
      ->check(number_from(0.0, 10000.0))
      ->capture_default_str();
  command
      .add_option("--lever-arm", choices.lever_arm,
                  "TRUTH of positions: estimate: the point of ESTIMATE's body that TRUTH follows is found too")
      ->check(CLI::IsMember({"estimate"}));
  command.add_option("--epochs", choices.epochs,
                     "TRUTH of positions: a table with time_s: only rows nearest to these times count, and tenths of "
                     "a second that have one");
}

int evaluate_positions(const std::string& estimate_path, const std::string& truth_path, const PositionChoices& choices,
                       const OutputOptions& output_options) {
  const evaluate::PositionTrack estimate = evaluate::read_position_track(estimate_path);
  const evaluate::PositionTrack truth = evaluate::read_position_track(truth_path);
  evaluate::PositionOptions options;
  if (choices.clock_marks.size() == 2) options.marks_s = std::pair(choices.clock_marks[0], choices.clock_marks[1]);
  options.window_s = choices.clock_window_ms / 1000.0;
  options.estimate_lever_arm = choices.lever_arm == "estimate";
  if (!choices.epochs.empty()) options.epochs_s = times_of(choices.epochs);
  const evaluate::PositionComparison comparison = evaluate::compare_positions(estimate, truth, options);
  Output output(output_options, kPositionColumns);
  write_row(output.rows(), estimate, comparison);
  output.finish();
  if (comparison.refused.empty()) return kExitAnswered;
  note(estimate_path + " against " + truth_path + ": " + comparison.why);
  return kExitNoAnswer;
}

}  // namespace pharos::tools
