// SPDX-License-Identifier: Apache-2.0
// pharos track: a recording and a target to poses of the target in each station's frame.
#include <CLI/CLI.hpp>
#include <memory>

#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/tracking/calibrated_tracker.hpp"
#include "pharos/tracking/method_tracker.hpp"
#include "tools/support/calibration_choice.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/pose_columns.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/residual_table.hpp"
#include "tools/support/solver_options.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"
#include "tools/support/words.hpp"
#include "tools/track/track_network.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos track hmd_static.edges.csv.gz --target hmd_static.target.csv --sensors sensors.csv > poses.csv\n"
    "  pharos track --sweeps sweeps.csv --stations stations.toml --target target.csv > poses.csv\n"
    "  pharos track dock.phraw --stations stations.toml --target target.csv > poses.csv   (Lighthouse 2.0)\n"
    "Each row is T_lighthouse_body in the frame of the station in the column station.\n"
    "--method motion: a row a sweep, time_s of the last hit used, the body's motion estimated, both stations' hits in\n"
    "one estimate where both see it (flag fused); noise shared by all hits of a sweep is taken as 0.87 of a bearing's\n"
    "variance unless --rho says otherwise. --method epoch: a row a cycle, time_s the mean time of the hits used;\n"
    "no check of a faulty target, which method motion refuses as refused_suspect_target.\n"
    "flags: uncalibrated, flash_weak, period_nominal, outliers (hits left out), prior, lock_poor, fused, "
    "residual_high\n"
    "(more is left than --sigma-arcsec explains: sigmas and the ambiguity test are too kind; give the real noise).\n"
    "--covariance: of T_lighthouse_body in the station's frame (of T_world_body with --sweeps), its roots of traces "
    "are\n"
    "sigma_rot_deg and sigma_pos_mm. --format tum: one station's poses, --station says whose.";

struct Options {
  std::string edges;
  std::string target;
  std::string method = "motion";
  std::string calibration = "ootx";
  std::string sensors;
  std::string sweeps, stations;  // of several stations, in place of edges
  int form = 1;
  bool raw_flashes = false;
  bool stats = false;
  std::optional<int> station;  // of the lines of TUM
  double largest_sigma_deg = motion::UncertaintyLimits{}.rotation_rad * kDegPerRad;
  double largest_sigma_mm = motion::UncertaintyLimits{}.position_m * kMmPerM;
  SolverOptions solver;
  OutputOptions output;

  motion::UncertaintyLimits limits() const { return {largest_sigma_deg * kRadPerDeg, largest_sigma_mm / kMmPerM}; }
  track::TrackOptions track() const {
    track::TrackOptions options;
    options.solve = solver.solve();
    options.form = form == 1 ? lighthouse::ModelForm::kForm1 : lighthouse::ModelForm::kForm2;
    options.smooth_flashes = !raw_flashes;
    return options;
  }
  tracking::MethodOptions tracker(const motion::SystematicErrors& systematic) const {
    return {method == "epoch" ? tracking::Method::kEpoch : tracking::Method::kMotion, track(), systematic, limits()};
  }
};

std::vector<std::string> columns() {
  std::vector<std::string> last = {"sigma_rot_deg", "sigma_pos_mm", "adop_deg_per_rad", "pdop_m_per_rad",
                                   "rms_arcsec",    "observations", "status",           "flags"};
  for (const std::string& column : second_solution_columns()) last.push_back(column);
  last.emplace_back("iterations");
  last.emplace_back("station_id");
  return with_pose_columns({"time_s", "station"}, last);
}

void write_result(const track::EpochResult& result, const std::string& station_id, host::RowWriter& rows) {
  rows.number(ticks_to_seconds(result.time_ticks)).integer(result.station);
  const LighthousePoseEstimate* estimate = result.pose ? &result.pose.value() : nullptr;
  if (estimate != nullptr) {
    write_pose(rows, estimate->pose);
    rows.number(estimate->sigma_rotation_rad() * kDegPerRad).number(estimate->sigma_position_m() * kMmPerM);
    // A moving target with too few recent hits has a pose, but no cycle for a precision factor.
    const bool factors = estimate->pdop_m_per_rad > 0.0;
    rows.number(factors ? std::optional(estimate->adop_deg_per_rad) : std::nullopt);
    rows.number(factors ? std::optional(estimate->pdop_m_per_rad) : std::nullopt);
    rows.number(estimate->residual_rms * kArcsecPerRad);
    rows.pose(row_pose(*estimate, ticks_to_seconds(result.time_ticks), std::to_string(result.station)));
  } else {
    write_no_pose(rows);
    rows.none(5);
  }
  rows.integer(result.observations).text(status_of(result.pose)).text(epoch_flag_words(result.flags));
  write_second_solution(rows, estimate);
  if (estimate != nullptr) {
    rows.integer(estimate->iterations);
  } else {
    rows.none();
  }
  rows.text(station_id).end_row();
}

// One run over a recording.
class Tracking {
 public:
  // The calibration must outlive this.
  Tracking(const Options& options, const CalibrationChoice& calibration, const Target& target)
      : calibration_(calibration),
        tracker_(calibration.policy(), target, options.tracker(calibration.systematic())),
        output_(options.output, columns()) {
    tracker_.resume(calibration.sent_ahead());
  }

  void push(const RecordingEvent& event) {
    if (is_lh2(event)) {
      throw host::InputError("a target of Lighthouse 2.0: give --stations, the file of where its stations stand");
    }
    if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&event)) {
      tracker_.push(*payload);
    } else if (const auto* sweep = std::get_if<lighthouse::Sweep>(&event)) {
      if (const auto result = tracker_.push(*sweep)) take(*result);
    }
  }
  void finish() {
    while (const auto result = tracker_.flush()) take(*result);
    output_.finish();
  }
  /// Results so far.
  void show() { output_.rows().flush(); }

  const ResidualTable& residuals() const { return residuals_; }
  std::size_t rows() { return output_.rows().rows(); }
  std::size_t poses() const { return poses_; }
  bool uncalibrated() const { return uncalibrated_ > 0; }
  /// The stations' relative pose contradicts the calibration.
  bool stations_moved() const { return tracker_.tracker().relative_pose_rejected(); }

 private:
  void take(track::EpochResult result) {
    if (result.pose) calibration_.widen(*result.pose);
    write_result(result, station_id_text(tracker_.sent().named_id(result.station)), output_.rows());
    if ((result.flags & track::kEpochUncalibrated) != 0) ++uncalibrated_;
    if (!result.pose) return;
    ++poses_;
    const tracking::MethodTracker& tracker = tracker_.tracker();
    for (std::size_t i = 0; i < tracker.bearing_count(); ++i) residuals_.push(result.station, tracker.bearing(i));
  }

  const CalibrationChoice& calibration_;
  tracking::CalibratedTracker<tracking::MethodTracker> tracker_;
  Output output_;
  ResidualTable residuals_;
  std::size_t poses_ = 0;
  std::size_t uncalibrated_ = 0;
};

void print_summary(const Options& options, const std::string& name, Tracking& tracking) {
  if (options.calibration == "ootx" && tracking.uncalibrated()) {
    note(name + ": rows flagged uncalibrated: a station's OOTX did not come twice; give --calibration FILE");
  }
  if (tracking.stations_moved()) {
    note(name + ": the two stations do not stand as the [[pair]] of " + options.calibration +
         " says: it was not used; calibrate anew");
  }
  if (tracking.poses() > 0) return;
  note(tracking.rows() > 0 ? name + ": every pose was refused; see the column status"
                           : name + ": no complete cycle; --stats says what became of its pulses");
}

void check_files(const Options& options) {
  require_one_standard_input(
      {{"EDGES", options.edges}, {"--target", options.target}, {"--calibration", options.calibration}});
  if (options.sensors.empty()) return;
  require_writable(options.sensors);
}

int run(Options options) {
  if (options.station) {
    if (options.output.row_format() != host::RowFormat::kTum || !options.sweeps.empty()) {
      throw host::InputError("--station chooses the lines of --format tum from EDGES; tables have a column station");
    }
    options.output.series = std::to_string(*options.station);
  }
  if (!options.sweeps.empty() || !options.stations.empty()) {
    if (options.stations.empty() || options.sweeps.empty() == options.edges.empty()) {
      throw host::InputError("give --stations with either --sweeps or a recorded stream of Lighthouse 2.0");
    }
    return track_network({options.sweeps, options.edges, options.stations, options.target, options.stats},
                         options.output);
  }
  if (options.edges.empty()) throw host::InputError("give EDGES, or --sweeps and --stations");
  check_files(options);
  const host::TargetFile target = host::read_target(options.target);
  note_target_shape(options.target, target.shape);
  const CalibrationChoice calibration(options.calibration, options.edges);
  const Target calibrated = calibration.target(target.target, options.track().form);
  Recording recording(options.edges);
  const auto tracking = std::make_unique<Tracking>(options, calibration, calibrated);
  Progress progress("track", "sweeps and payloads");
  recording.on_pause([&tracking] { tracking->show(); });
  while (const std::optional<RecordingEvent> event = recording.next()) {
    tracking->push(*event);
    progress.step();
  }
  tracking->finish();
  if (!options.sensors.empty()) tracking->residuals().write({options.output.json, options.sensors});
  recording.print_remarks();
  if (options.stats) recording.print_statistics();
  print_summary(options, recording.name(), *tracking);
  return tracking->poses() > 0 ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_track(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("track", "A recording and a target to poses");
  const auto options = std::make_shared<Options>();
  command->add_option(
      "EDGES", options->edges,
      "Table sensor,rise_ticks,fall_ticks (20 ns ticks) or a recorded serial stream; .gz; - is standard input");
  command->add_option(
      "--sweeps", options->sweeps,
      "In place of EDGES: hits of one to 16 stations, as `pharos convert` writes them; experimental (poses of a "
      "quickly moved target can be off by more than their sigmas say); poses are T_world_body");
  command->add_option(
      "--stations", options->stations,
      "Where the stations of --sweeps, or of a recorded stream of Lighthouse 2.0, stand (stations.toml)");
  command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]")->required();
  command
      ->add_option("--method", options->method,
                   "motion: every hit at its own instant, a row a sweep; epoch: each cycle alone, the paper's way")
      ->check(CLI::IsMember({"motion", "epoch"}))
      ->capture_default_str();
  command
      ->add_option("--calibration", options->calibration,
                   "ootx (what the stations send; a file is read twice), none, or a TOML file: of `pharos calibrate "
                   "lighthouse`, whose sensor positions hold too, or of [[station]] tables")
      ->capture_default_str();
  command
      ->add_option("--form", options->form, "Sign form of the station model's curve term; real stations fit 1 better")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  command
      ->add_option("--largest-sigma-deg", options->largest_sigma_deg,
                   "method motion: poses known less well (1 sigma) are refused, too_uncertain")
      ->check(CLI::Range(0.001, 180.0))
      ->capture_default_str();
  command->add_option("--largest-sigma-mm", options->largest_sigma_mm, "The same of the position")
      ->check(CLI::Range(0.01, 1e4))
      ->capture_default_str();
  command->add_flag("--raw-flashes", options->raw_flashes, "Flash times as measured, not smoothed");
  command->add_option("--sensors", options->sensors, "File for what is left of each sensor: mean, sd, rms per station")
      ->check(output_place());
  command->add_flag("--stats", options->stats, "Every counter at the end, on standard error");
  add_solver_options(*command, options->solver);
  add_output_options(*command, options->output);
  add_pose_format_options(*command, options->output);
  command
      ->add_option("--station", options->station,
                   "With --format tum: the station whose poses are written (default: that of the first good one)")
      ->check(CLI::Range(0, 1));
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
