// SPDX-License-Identifier: Apache-2.0
// pharos fuse: pose tables of all sources to one state of the target in the vehicle's frame.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/fusion/target_fuser.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/support/input_error.hpp"
#include "tools/fuse/fused_rows.hpp"
#include "tools/fuse/fused_tables.hpp"
#include "tools/fuse/range_errors.hpp"
#include "tools/fuse/truth_errors.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kFuseExample =
    "Example:\n"
    "  pharos fuse lighthouse.csv tof.csv ring2.csv slam.csv --mounting mounting.toml --truth truth.csv > fused.csv\n"
    "  pharos fuse tof=night/poses.csv.gz ring2=night/circles.csv --mounting mounting.toml --format tum --output "
    "f.tum\n"
    "Each table is what `pharos track`, `tof`, `circles` or `slam --format csv` prints; the source's name is NAME, or "
    "the\n"
    "file's name up to its first dot. A row is T_vehicle_target, predicted to its time with what had arrived by then\n"
    "(column arrival_s, else a pose arrives at its own time). mode: searching, single, fused, conflict (two sources\n"
    "contradict each other, or one alone its own track, and nothing tells which is wrong), coasting, lost. A "
    "protection level that is not "
    "available\n"
    "is empty. excluded: NAME:REASON joined by '|'.";

struct FuseOptions {
  std::vector<std::string> tables;
  std::string mounting;
  std::string truth;
  std::string by_range;
  std::string format = "csv";
  double rate_hz = 20.0;
  host::SourceTableChoice table;
  host::FusionChoices choices;
  std::vector<double> inertia{1.0, 1.0, 1.0};
  OutputOptions output;
};

// Where states go: a table, or TUM lines.
class FuseOutput {
 public:
  FuseOutput(const FuseOptions& options, const host::TargetFuser& fuser) : names_(fuser.names()) {
    if (!options.truth.empty()) truth_.emplace(options.truth);
    if (!options.by_range.empty()) ranges_.emplace(options.truth, fuser.sources());
    by_range_ = options.by_range;
    if (options.format == "csv" || options.output.json) {
      table_ = std::make_unique<Output>(options.output, fused_columns(truth_.has_value()));
    }
    path_ = options.output.path;
  }

  void write(const fusion::TargetState& state) {
    const std::optional<StateError> error = truth_ ? truth_->add(state) : std::nullopt;
    valid_ += state.valid ? 1 : 0;
    if (ranges_) ranges_->add(state);
    if (table_) {
      write_fused_row(state, names_, error, truth_.has_value(), table_->rows());
    } else if (state.valid) {
      tum_ += tum_line(state);
    }
  }

  void add(const ArrivedPose& pose) {
    if (ranges_) ranges_->add(pose.source, pose.row);
  }

  int finish() {
    if (ranges_) ranges_->write(by_range_);
    if (table_) {
      table_->finish();
    } else {
      host::write_file(path_, tum_);
    }
    if (truth_) note(truth_->summary());
    return valid_ > 0 ? kExitAnswered : kExitNoAnswer;
  }

 private:
  std::vector<std::string> names_;
  std::optional<TruthErrors> truth_;
  std::optional<RangeErrors> ranges_;
  std::string by_range_;
  std::unique_ptr<Output> table_;
  std::string tum_;
  std::string path_;
  std::size_t valid_ = 0;
};

void remark_refusals(const fusion::TargetEstimator& estimator, const FusedTables& tables) {
  constexpr std::array<const char*, static_cast<std::size_t>(fusion::Refusal::kCount)> kWords = {
      "",
      "unknown source",
      "not finite or no rotation",
      "covariance not positive definite",
      "time goes back",
      "time far ahead of all others",
      "too late"};
  for (std::size_t reason = 1; reason < kWords.size(); ++reason) {
    const std::uint64_t count = estimator.refused(static_cast<fusion::Refusal>(reason));
    if (count > 0) note(std::to_string(count) + " poses refused: " + kWords[reason]);
  }
  if (tables.refused > 0) note(std::to_string(tables.refused) + " rows without a pose");
  const fusion::FusionCounters& counters = estimator.counters();
  if (counters.exclusions > 0 || counters.conflicts > 0) {
    note(std::to_string(counters.exclusions) + " exclusions, " + std::to_string(counters.readmissions) +
         " readmissions, " + std::to_string(counters.conflicts) + " conflicts");
  }
  if (counters.unresolved > 0) note(std::to_string(counters.unresolved) + " contradictions that nothing could judge");
  if (counters.refuted > 0) note(std::to_string(counters.refuted) + " tracks refuted by excluded sources that agreed");
}

int run(const FuseOptions& options) {
  if (!options.by_range.empty() && options.truth.empty()) throw host::InputError("--by-range needs --truth");
  for (const std::string& path : {options.output.path, options.by_range}) {
    if (!path.empty() && path != "-") require_writable(path);
  }
  const host::Mounting mounting = host::read_mounting_file(options.mounting);
  const FusedTables tables = read_fused_tables(options.tables, mounting, options.table);
  host::FusionChoices choices = options.choices;
  std::copy_n(options.inertia.begin(), choices.inertia.size(), choices.inertia.begin());
  host::TargetFuser fuser(tables.sources, choices);
  const fusion::TargetEstimator& estimator = fuser.estimator();
  FuseOutput output(options, fuser);
  std::int64_t look = 0;
  const double first_s = tables.poses.front().arrival_s;
  const auto look_s = [&] { return first_s + static_cast<double>(look) / options.rate_hz; };
  for (const ArrivedPose& pose : tables.poses) {
    for (; options.rate_hz > 0.0 && look_s() < pose.arrival_s; ++look) {
      // Nothing has been heard for so long that there is nothing to tell until the next pose.
      if (pose.arrival_s - look_s() > 2.0 * estimator.settings().detection.coasting_s &&
          !fuser.state(std::llround(look_s() * 1e9)).valid) {
        look = static_cast<std::int64_t>(std::floor((pose.arrival_s - first_s) * options.rate_hz));
        continue;
      }
      output.write(fuser.state(std::llround(look_s() * 1e9)));
    }
    output.add(pose);
    const fusion::Outcome outcome = fuser.push(pose.source, pose.row);
    if (options.rate_hz == 0.0 && outcome.refusal == fusion::Refusal::kNone) {
      output.write(fuser.state(estimator.newest_ns()));
    }
  }
  remark_refusals(estimator, tables);
  return output.finish();
}

CLI::Range within(host::ChoiceRange range) { return {range.min, range.max}; }

void add_choices(CLI::App& command, FuseOptions& options) {
  host::FusionChoices& choices = options.choices;
  const auto positive = within(host::kPositiveRange);
  const std::vector<std::string> motions(host::kMotionWords.begin(), host::kMotionWords.end());
  command.add_option("--motion", choices.motion, "How the target moves: free, orbit, tumbling or tumbling_orbit")
      ->check(CLI::IsMember(motions))
      ->capture_default_str();
  command
      .add_option("--mean-motion-rad-s", choices.mean_motion_rad_s,
                  "orbit: of the orbit, whose radial, along-track and normal axes are the vehicle's x, y, z")
      ->check(within(host::kMeanMotionRange))
      ->capture_default_str();
  command.add_option("--inertia", options.inertia, "tumbling: ratios of the moments about the target's x, y, z")
      ->expected(3)
      ->delimiter(',');
  command.add_option("--acceleration-density", choices.acceleration_density, "Of white acceleration, m^2/s^3")
      ->check(positive)
      ->capture_default_str();
  command.add_option("--angular-density", choices.angular_acceleration_density, "The same of rotation, rad^2/s^3")
      ->check(positive)
      ->capture_default_str();
  command.add_option("--bias-deg", choices.bias_deg, "1 sigma of each source's own slow error")
      ->check(within(host::kBiasDegRange))
      ->capture_default_str();
  command.add_option("--bias-mm", choices.bias_mm, "The same of the position")
      ->check(within(host::kBiasMmRange))
      ->capture_default_str();
  command.add_option("--bias-time-s", choices.bias_time_s, "Its time constant")->check(positive)->capture_default_str();
  command.add_option("--risk-per-hour", choices.risk_per_hour, "That the truth is outside of the protection level")
      ->check(within(host::kRiskRange))
      ->capture_default_str();
  command.add_option("--faults-per-hour", choices.faults_per_hour, "Expected, of each kind and source")
      ->check(within(host::kFaultsRange))
      ->capture_default_str();
}

}  // namespace

void add_fuse(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("fuse", "Pose tables of all sources to one state in the vehicle's frame");
  const auto options = std::make_shared<FuseOptions>();
  command->add_option("TABLES", options->tables, "[NAME=]TABLE for each source")->required();
  command->add_option("--mounting", options->mounting, "Where sensors and features are (pharos calibrate mounting)")
      ->required();
  command->add_option("--truth", options->truth, "T_vehicle_target: adds errors, NEES and whether the level held");
  command
      ->add_option("--by-range", options->by_range,
                   "Errors of the state and of each source in bins of one metre of the true distance, into this file")
      ->check(output_place());
  command->add_option("--format", options->format, "csv, or tum: timestamp tx ty tz qx qy qz qw")
      ->check(CLI::IsMember({"csv", "tum"}))
      ->capture_default_str();
  command->add_option("--rate", options->rate_hz, "Rows a second; 0: one for each pose")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command->add_option("--frame-rate", options->table.rate_hz, "Of tables that count frames, Hz")
      ->check(CLI::Range(1e-3, 1e4));
  command->add_option("--station", options->table.station, "Of a lighthouse table with several");
  add_choices(*command, *options);
  add_output_options(*command, options->output);
  command->footer(kFuseExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
