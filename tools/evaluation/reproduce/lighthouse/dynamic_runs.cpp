// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/dynamic_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "tools/evaluation/reproduce/lighthouse/calibration_session.hpp"
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"
#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kPublishedRuns = 10;

struct PublishedRun {
  const char* rotation_rms_deg;
  const char* rotation_max_deg;
  const char* position_rms_mm;
  const char* position_max_mm;
};

// Table 2 of paper 002.
constexpr std::array<PublishedRun, kPublishedRuns> kTable2 = {{
    {"0.96", "4.76", "12.7", "42.6"},
    {"0.94", "3.76", "16.9", "43.5"},
    {"0.91", "2.90", "17.8", "44.3"},
    {"1.07", "3.70", "19.0", "45.4"},
    {"0.95", "5.58", "9.9", "20.5"},
    {"0.85", "3.00", "10.1", "25.5"},
    {"0.78", "5.76", "14.3", "32.0"},
    {"0.86", "3.11", "10.2", "27.3"},
    {"0.18", "0.91", "9.7", "31.2"},
    {"0.21", "0.82", "3.5", "11.6"},
}};

// Root mean square and maximum of errors.
class ErrorStatistics {
 public:
  void push(const PoseError& error) {
    ++count_;
    rotation_squares_ += error.rotation_deg * error.rotation_deg;
    position_squares_ += error.position_mm * error.position_mm;
    max_.rotation_deg = std::max(max_.rotation_deg, error.rotation_deg);
    max_.position_mm = std::max(max_.position_mm, error.position_mm);
  }
  std::size_t count() const { return count_; }
  PoseError max() const { return max_; }
  PoseError rms() const {
    const auto n = static_cast<double>(std::max<std::size_t>(count_, 1));
    return {std::sqrt(rotation_squares_ / n), std::sqrt(position_squares_ / n)};
  }

 private:
  std::size_t count_ = 0;
  double rotation_squares_ = 0.0;
  double position_squares_ = 0.0;
  PoseError max_;
};

// A larger rotation error is not noise: another minimum fitted better.
constexpr double kOtherMinimum_deg = 10.0;

// Limits of the stated sigma for the last column: the requirement of a docking. 2.5 and 3 of these sigmas are half a
// degree and 6 mm.
constexpr motion::UncertaintyLimits kGoodEnough{0.2 * kRadPerDeg, 2e-3};

struct DynamicRun {
  ErrorStatistics sure;   // status ok
  ErrorStatistics right;  // of those, within kOtherMinimum_deg
  ErrorStatistics all;    // ok and ambiguous
  int refused = 0;

  double answered_percent() const {
    return 100.0 * static_cast<double>(sure.count()) /
           std::max(1.0, static_cast<double>(all.count()) + static_cast<double>(refused));
  }
  double wrong_percent() const {
    return sure.count() == 0
               ? 0.0
               : 100.0 * static_cast<double>(sure.count() - right.count()) / static_cast<double>(sure.count());
  }
};

// The method of the paper: each cycle alone, flashes as measured, the residual (6) as printed.
track::TrackOptions paper_method() {
  track::TrackOptions options;
  options.solve.residual = pose::Residual::kTangent;
  options.solve.rho = kPaperRho;
  options.smooth_flashes = false;
  return options;
}

template <class Tracker>
DynamicRun evaluate(const SimulatedRun& run, const RunAssumptions& assumptions, Tracker tracker) {
  DynamicRun out;
  const auto kept = std::make_unique<Tracker>(std::move(tracker));
  run.feed(*kept, assumptions, [&](const track::EpochResult& result, const LighthouseFromBody& truth) {
    if (!result.pose) {
      ++out.refused;
      return;
    }
    const PoseError error = error_of(result.pose->pose, truth);
    out.all.push(error);
    if (result.pose->ambiguous()) return;
    out.sure.push(error);
    if (error.rotation_deg < kOtherMinimum_deg) out.right.push(error);
  });
  return out;
}

// The columns beside the paper's method, in this order.
enum Column : std::size_t { kPaper, kCalibration, kMotion, kBoth, kColumns };
using FourColumns = std::array<DynamicRun, kColumns>;

FourColumns four_columns(const SimulatedRun& run, const CalibrationSession& session, std::uint64_t seed) {
  const RunAssumptions announced = run.as_announced(), calibrated = calibrate_for(run, session, seed);
  const track::TrackOptions paper = paper_method();
  track::TrackOptions track_options;
  track_options.solve.rho = kPaperRho;
  const auto motion = [&](const RunAssumptions& assumptions, const motion::UncertaintyLimits& limits) {
    return motion::MotionTracker(assumptions.target,
                                 motion::motion_options(track_options, assumptions.systematic, limits));
  };
  return {evaluate(run, announced, track::EpochTracker(announced.target, paper)),
          evaluate(run, calibrated, track::EpochTracker(calibrated.target, paper)),
          evaluate(run, announced, motion(announced, {})), evaluate(run, calibrated, motion(calibrated, kGoodEnough))};
}

SimulatedRun fly(double run_s, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(run_s);
  scenario.errors = sim::ErrorScenario::workshop();
  scenario.stations.front().calibration.reset();  // typical values, known from OOTX except for the workshop errors
  scenario.trajectory = sim::make_random_manoeuvre({}, run_s, sim::RandomStream(seed, "table 2"));
  return SimulatedRun(std::move(scenario), seed);
}

// Adds a row whose figure is `value` of each column's run.
template <class Value>
void add_row(const std::string& what, const char* unit, const char* published, const FourColumns& columns,
             const std::string& remark, std::vector<ComparisonRow>& rows, Value&& value) {
  rows.push_back({"table 2", what, unit, published, value(columns[kPaper]), remark,
                  FurtherColumns{value(columns[kCalibration]), value(columns[kMotion]), value(columns[kBoth])}});
}

void add_run_rows(std::size_t run, const FourColumns& columns, std::vector<ComparisonRow>& rows) {
  const PublishedRun published = run < kPublishedRuns ? kTable2[run] : PublishedRun{"", "", "", ""};
  const std::string name = "run " + std::to_string(run + 1) + ": ";
  const DynamicRun& result = columns[kPaper];
  const std::string counts =
      std::to_string(result.sure.count()) + " cycles ok; " + std::to_string(result.all.count() - result.sure.count()) +
      " ambiguous and " + std::to_string(result.refused) + " refused left out; " +
      std::to_string(result.sure.count() - result.right.count()) + " of the ok in another minimum";
  add_row(name + "rotation RMS", "deg", published.rotation_rms_deg, columns, counts, rows,
          [](const DynamicRun& r) { return r.sure.rms().rotation_deg; });
  add_row(name + "rotation maximum", "deg", published.rotation_max_deg, columns, "", rows,
          [](const DynamicRun& r) { return r.sure.max().rotation_deg; });
  add_row(name + "position RMS", "mm", published.position_rms_mm, columns, "", rows,
          [](const DynamicRun& r) { return r.sure.rms().position_mm; });
  add_row(name + "position maximum", "mm", published.position_max_mm, columns, "", rows,
          [](const DynamicRun& r) { return r.sure.max().position_mm; });
  add_row(name + "answered, one pose", "%", "", columns, "", rows,
          [](const DynamicRun& r) { return r.answered_percent(); });
}

// Medians of the ten published values.
constexpr const char* kPublishedRotation_deg = "0.885";
constexpr const char* kPublishedPosition_mm = "11.45";

// Medians over the runs, of each column.
void add_medians(const std::vector<FourColumns>& runs, std::vector<ComparisonRow>& rows) {
  const auto add = [&](const char* what, const char* unit, const char* published, auto&& value) {
    std::array<double, kColumns> middle{};
    for (std::size_t column = 0; column < kColumns; ++column) {
      std::vector<double> values;
      for (const FourColumns& run : runs) values.push_back(value(run[column]));
      middle[column] = median_of(values);
    }
    rows.push_back({"table 2", std::string(what) + " (median of runs)", unit, published, middle[kPaper], "",
                    FurtherColumns{middle[kCalibration], middle[kMotion], middle[kBoth]}});
  };
  add("rotation RMS", "deg", kPublishedRotation_deg, [](const DynamicRun& r) { return r.sure.rms().rotation_deg; });
  add("position RMS", "mm", kPublishedPosition_mm, [](const DynamicRun& r) { return r.sure.rms().position_mm; });
  add("answered, one pose", "%", "", [](const DynamicRun& r) { return r.answered_percent(); });
  add("answers more than 10 deg off (another minimum)", "%", "", [](const DynamicRun& r) { return r.wrong_percent(); });
  add("rotation RMS without those", "deg", kPublishedRotation_deg,
      [](const DynamicRun& r) { return r.right.rms().rotation_deg; });
  add("position RMS without those", "mm", kPublishedPosition_mm,
      [](const DynamicRun& r) { return r.right.rms().position_mm; });
}

}  // namespace

std::vector<ComparisonRow> reproduce_dynamic_runs(const DynamicRunsOptions& options) {
  Progress progress("table 2", "runs", static_cast<std::size_t>(options.runs));
  std::vector<ComparisonRow> rows;
  std::vector<FourColumns> runs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(options.runs); ++i) {
    const SimulatedRun run = fly(options.run_s, options.seed + i);
    runs.push_back(four_columns(run, options.calibration, options.seed + i));
    add_run_rows(i, runs.back(), rows);
    progress.step();
  }
  if (!runs.empty()) add_medians(runs, rows);
  return rows;
}

}  // namespace pharos::tools
