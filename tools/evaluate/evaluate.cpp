// SPDX-License-Identifier: Apache-2.0
// pharos evaluate: poses compared with an external truth (002, section 4.3).
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "host/files/atomic_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluate/comparison.hpp"
#include "tools/evaluate/error_plot.hpp"
#include "tools/evaluate/evaluate_positions.hpp"
#include "tools/evaluate/figure_table.hpp"
#include "tools/evaluate/known_transform.hpp"
#include "tools/evaluate/position_track.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/standard_input.hpp"

namespace pharos::tools {
namespace {

using evaluate::AlignMode;

constexpr const char* kExample =
    "Example:\n"
    "  pharos evaluate poses.csv mocap.csv --align hand-eye --time-offset auto --plot errors.svg\n"
    "  pharos evaluate path.tum mav0/state_groundtruth_estimate0/data.csv --align hand-eye\n"
    "poses.csv: a table of pharos track; mocap.csv: time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m of the marker body.\n"
    "hand-eye finds the pose of the motion capture's frame in ESTIMATE's and that of ESTIMATE's body in the marker\n"
    "body: T_estimate = world * T_truth * body. se3 finds the first only, from positions by least squares: where "
    "TRUTH\n"
    "is of another body than ESTIMATE (EuRoC's is the IMU's, not the camera's), its ate_mm holds their lever arm.\n"
    "--transform FILE: both frames are known beforehand, as in paper 002, section 4.3; nothing is fitted.\n"
    "rot_* and pos_*: errors (25); spread_*: (23), errors about their mean; *_normalised_square is 1 where stated\n"
    "sigmas are honest. Refused and ambiguous rows are counted and left out.\n"
    "  pharos evaluate poses.csv mocap.csv.gz --clock-marks 13.94,45.56 --epochs crossing_beam.csv --lever-arm "
    "estimate\n"
    "TRUTH of positions alone (time_s,x_m,y_m,z_m): rigid alignment, offset and rate of the clocks searched, figures\n"
    "of the position and pos_nees_per_dof; ESTIMATE may be positions too.";

struct Options {
  std::string estimate;
  std::string truth;
  AlignMode mode = AlignMode::kNone;
  std::string transform;
  std::string time_offset = "0";
  double max_gap_s = 0.0;
  double relative_s = 1.0;
  int station = -1;
  evaluate::TrajectoryChoice choice;
  PositionChoices positions;
  std::string plot;
  bool table = false;
  OutputOptions output;
};

const std::vector<std::string> kColumns = {"align",
                                           "time_offset_s",
                                           "rows",
                                           "compared",
                                           "refused",
                                           "ambiguous",
                                           "flagged",
                                           "outside",
                                           "in_gap",
                                           "coverage",
                                           "rot_rms_deg",
                                           "rot_median_deg",
                                           "rot_p95_deg",
                                           "rot_p99_deg",
                                           "rot_max_deg",
                                           "spread_rot_deg",
                                           "rpe_rot_deg",
                                           "rot_within_1sigma",
                                           "rot_within_2sigma",
                                           "rot_within_3sigma",
                                           "rot_normalised_square",
                                           "pos_rms_mm",
                                           "pos_median_mm",
                                           "pos_p95_mm",
                                           "pos_p99_mm",
                                           "pos_max_mm",
                                           "spread_pos_mm",
                                           "rpe_pos_mm",
                                           "pos_within_1sigma",
                                           "pos_within_2sigma",
                                           "pos_within_3sigma",
                                           "pos_normalised_square",
                                           "ate_mm",
                                           "rpe_s",
                                           "rpe_pairs",
                                           "world_qw",
                                           "world_qx",
                                           "world_qy",
                                           "world_qz",
                                           "world_tx_m",
                                           "world_ty_m",
                                           "world_tz_m",
                                           "body_qw",
                                           "body_qx",
                                           "body_qy",
                                           "body_qz",
                                           "body_tx_m",
                                           "body_ty_m",
                                           "body_tz_m",
                                           "open",
                                           "status"};
constexpr std::size_t kFigureColumns = 11;  // of each half
constexpr std::size_t kOtherFigures = 3;
constexpr std::size_t kPoseColumns = 7;

void write_half(host::RowWriter& rows, const evaluate::Figures& figures, double scale) {
  for (const double value : {figures.error.rms, figures.error.median, figures.error.p95, figures.error.p99,
                             figures.error.max, figures.spread}) {
    rows.number(value * scale);
  }
  if (figures.relative) {
    rows.number(*figures.relative * scale);
  } else {
    rows.none();
  }
  if (!figures.consistency) {
    rows.none(4);
    return;
  }
  for (const double fraction : figures.consistency->within) rows.number(fraction);
  rows.number(figures.consistency->normalised_square);
}

template <class AnyPose>
void write_any_pose(host::RowWriter& rows, const AnyPose& pose) {
  const Quaternion q = pose.quaternion();
  for (const double v : {q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()}) rows.number(v);
}

std::string open_parts(const evaluate::Aligned& aligned) {
  std::string text;
  for (const evaluate::UnobservableDirection& open : aligned.open) text += (text.empty() ? "" : "; ") + open.parts();
  return text;
}

const char* name_of(AlignMode mode, bool known) {
  if (known) return "known";
  return mode == AlignMode::kNone ? "none" : mode == AlignMode::kSe3 ? "se3" : "hand-eye";
}

void write_count(host::RowWriter& rows, std::size_t count) { rows.integer(static_cast<std::int64_t>(count)); }

void write_figures(host::RowWriter& rows, const evaluate::Comparison& c, double relative_s) {
  rows.number(c.figures.coverage);
  write_half(rows, c.figures.rotation, kDegPerRad);
  write_half(rows, c.figures.position, kMmPerM);
  rows.number(c.figures.ate_m * kMmPerM).number(relative_s);
  write_count(rows, c.figures.relative_pairs);
  write_any_pose(rows, c.aligned.alignment.world);
  write_any_pose(rows, c.aligned.alignment.body);
  rows.text(open_parts(c.aligned)).text("ok").end_row();
}

void write_row(host::RowWriter& rows, const Options& options, const evaluate::TrajectoryFile<evaluate::EstimatePose>& e,
               const evaluate::Comparison& c) {
  const bool answered = c.refused.empty();
  rows.text(name_of(options.mode, !options.transform.empty()));
  if (answered) {
    rows.number(c.aligned.alignment.time_offset_s);
  } else {
    rows.none();
  }
  write_count(rows, e.rows);
  write_count(rows, answered ? c.pairs.pairs.size() : 0);
  write_count(rows, e.refused);
  write_count(rows, e.ambiguous);
  write_count(rows, e.flagged);
  write_count(rows, c.pairs.outside);
  write_count(rows, c.pairs.in_gap);
  if (answered) {
    write_figures(rows, c, options.relative_s);
  } else {
    rows.none(1 + 2 * kFigureColumns + kOtherFigures + 2 * kPoseColumns).text(open_parts(c.aligned));
    rows.text(c.refused).end_row();
  }
}

// A row for programs, a table for people: asked for, or on a terminal.
void write(const Options& options, const evaluate::TrajectoryFile<evaluate::EstimatePose>& e,
           const evaluate::Comparison& c) {
  const bool terminal = options.output.path == "-" && !options.output.json && ::isatty(STDOUT_FILENO) == 1;
  if (options.table || terminal) {
    const std::size_t compared = c.refused.empty() ? c.pairs.pairs.size() : 0;
    const evaluate::RowCounts counts{e.rows,    compared,        e.refused,     e.ambiguous,
                                     e.flagged, c.pairs.outside, c.pairs.in_gap};
    host::write_file(options.output.path, figure_table(c, counts, options.relative_s));
    return;
  }
  Output output(options.output, kColumns);
  write_row(output.rows(), options, e, c);
  output.finish();
}

evaluate::ComparisonOptions comparison_options(const Options& options) {
  evaluate::ComparisonOptions result;
  result.mode = options.mode;
  if (!options.transform.empty()) result.known = evaluate::read_transform(options.transform);
  result.time_offset_s.reset();
  if (options.time_offset != "auto") result.time_offset_s = std::stod(options.time_offset);
  if (options.max_gap_s > 0.0) result.max_gap_s = options.max_gap_s;
  result.relative_s = options.relative_s;
  return result;
}

void remark_repeated(const std::string& path, std::size_t repeated) {
  if (repeated == 0) return;
  note(path + ": " + std::to_string(repeated) + " rows repeat the time and the pose of the row before: taken once");
}

void remark(const Options& options, const evaluate::Comparison& c) {
  if (!c.refused.empty()) {
    note(options.estimate + " against " + options.truth + ": " + c.why);
    return;
  }
  for (const evaluate::UnobservableDirection& open : c.aligned.open) {
    note("the motion leaves open " + open.words() + "; the errors do not depend on it");
  }
}

int run(const Options& options) {
  require_one_standard_input(
      {{"ESTIMATE", options.estimate}, {"TRUTH", options.truth}, {"--transform", options.transform}});
  if (!options.plot.empty()) require_writable(options.plot);
  if (options.truth != "-" && evaluate::is_position_table(options.truth)) {
    if (!options.transform.empty()) {
      throw host::InputError("--transform: a TRUTH of positions is aligned by itself; leave the option out");
    }
    return evaluate_positions(options.estimate, options.truth, options.positions, options.output);
  }
  evaluate::TrajectoryChoice choice = options.choice;
  if (options.station >= 0) choice.station = options.station;
  const auto estimate = evaluate::read_trajectory<evaluate::EstimatePose>(options.estimate, choice);
  const auto truth = evaluate::read_trajectory<evaluate::TruthPose>(options.truth, choice);
  remark_repeated(options.estimate, estimate.repeated);
  remark_repeated(options.truth, truth.repeated);
  const evaluate::Comparison comparison = evaluate::compare(estimate, truth, comparison_options(options));
  write(options, estimate, comparison);
  remark(options, comparison);
  if (!comparison.refused.empty()) return kExitNoAnswer;
  if (!options.plot.empty()) {
    evaluate::plot_errors(options.plot, evaluate::errors_of(comparison.pairs.pairs, comparison.aligned.alignment),
                          comparison.figures, comparison.coverage_gap_s);
  }
  return kExitAnswered;
}

CLI::Validator auto_or_seconds() {
  const CLI::Validator number = number_from(-1e10, 1e10);
  return {[number](std::string& text) {
            if (text == "auto" || number(text).empty()) return std::string();
            return text + " is neither auto nor a number of seconds";
          },
          "auto or seconds", "offset"};
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("evaluate", "Poses against an outside truth: errors, one row or a table");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "ESTIMATE", options->estimate,
          "Table with time_s (or utime, frame) and qw..tz_m, TUM lines or EuRoC's CSV; .gz; - is standard input")
      ->required();
  command->add_option("TRUTH", options->truth, "The same forms; motion capture: time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m")
      ->required();
  const std::map<std::string, AlignMode> modes = {
      {"none", AlignMode::kNone}, {"se3", AlignMode::kSe3}, {"hand-eye", AlignMode::kHandEye}};
  CLI::Option* align =
      command->add_option("--align", options->mode, "none, se3 (worlds) or hand-eye (worlds and bodies)")
          ->transform(CLI::CheckedTransformer(modes).description("{hand-eye,none,se3}"));
  command
      ->add_option(
          "--transform", options->transform,
          "A known alignment instead: one row of qw..tz_m (ESTIMATE's frame from TRUTH's), of the paper's psi_0 "
          "(phi_x_rad..z_mm), or of this command")
      ->excludes(align);
  command
      ->add_option("--time-offset", options->time_offset,
                   "Seconds to add to ESTIMATE's times, or auto: found from the motion")
      ->check(auto_or_seconds())
      ->capture_default_str();
  command->add_option("--max-gap", options->max_gap_s, "Longest step of TRUTH bridged, s; default: 3.5 median steps")
      ->check(number_from(1e-6, 1e6));
  command->add_option("--rpe", options->relative_s, "Time over which motion errors are taken, s")
      ->check(number_from(1e-6, 1e6))
      ->capture_default_str();
  command->add_option("--station", options->station, "Only rows of this station")->check(number_from(0, 1e6));
  command->add_option("--rate", options->choice.frame_rate_hz, "Frames a second, for tables with frame instead of time")
      ->check(number_from(1e-6, 1e6))
      ->capture_default_str();
  command->add_flag("--ambiguous", options->choice.keep_ambiguous, "Count ambiguous poses among the answers");
  command->add_option("--without", options->choice.without_flags, "Leave out rows with this word in flags; repeatable");
  command->add_option("--plot", options->plot, "File for a picture (SVG) of the errors over time")
      ->check(output_place())
      ->check(picture_kind(".svg"));
  add_position_options(*command, options->positions);
  add_output_options(*command, options->output);
  command
      ->add_flag("--table", options->table,
                 "A table for people instead of the row; so on a terminal, where no -o is given")
      ->excludes("--json");
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
