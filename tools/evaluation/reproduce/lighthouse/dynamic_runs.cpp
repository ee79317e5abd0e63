// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/dynamic_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "tools/evaluation/reproduce/lighthouse/calibration_session.hpp"
#include "tools/evaluation/reproduce/lighthouse/flight_pictures.hpp"
#include "tools/evaluation/reproduce/lighthouse/paper_tracker.hpp"
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
  void add(const ErrorStatistics& other) {
    count_ += other.count_;
    rotation_squares_ += other.rotation_squares_;
    position_squares_ += other.position_squares_;
    max_.rotation_deg = std::max(max_.rotation_deg, other.max_.rotation_deg);
    max_.position_mm = std::max(max_.position_mm, other.max_.position_mm);
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

  void add(const DynamicRun& other) {
    sure.add(other.sure);
    right.add(other.right);
    all.add(other.all);
    refused += other.refused;
  }
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

// One method on one flight: `each` sees the tracker, the result and the truth of every answer.
template <class Tracker, class Each>
DynamicRun evaluate(const SimulatedRun& run, const RunAssumptions& assumptions, Tracker tracker, Each&& each) {
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
    each(*kept, result, truth);
  });
  return out;
}

// The methods, in this order.
enum Column : std::size_t { kPaper, kCalibration, kMotion, kBoth, kColumns };
struct Flight {
  std::array<DynamicRun, kColumns> columns;
  DynamicRun from_truth;  // the paper's method, its descent begun at the true pose
  FlightSeries theirs, ours;
};

void record(const track::EpochResult& result, const LighthouseFromBody& truth, FlightSeries& series) {
  series.push_back({ticks_to_seconds(result.time_ticks),
                    result.pose->pose,
                    truth,
                    {result.pose->sigma_rotation_rad() * kDegPerRad, result.pose->sigma_position_m() * kMmPerM}});
}

Flight fly_by_all_methods(const SimulatedRun& run, const CalibrationSession& session, std::uint64_t seed) {
  const RunAssumptions announced = run.as_announced(), calibrated = calibrate_for(run, session, seed);
  track::TrackOptions track_options;
  track_options.solve.rho = kPaperRho;
  const auto motion = [&](const RunAssumptions& assumptions, const motion::UncertaintyLimits& limits) {
    return motion::MotionTracker(assumptions.target,
                                 motion::motion_options(track_options, assumptions.systematic, limits));
  };
  const auto ignore = [](const auto&...) {};
  Flight flight;
  flight.columns[kPaper] = evaluate(run, announced, paper002::PaperTracker(announced.target, kPaperRho),
                                    [&](const auto& tracker, const auto& result, const auto& truth) {
                                      record(result, truth, flight.theirs);
                                      const auto again = tracker.solved_from(truth);
                                      if (again) flight.from_truth.sure.push(error_of(again->pose, truth));
                                    });
  flight.columns[kCalibration] =
      evaluate(run, calibrated, paper002::PaperTracker(calibrated.target, kPaperRho), ignore);
  flight.columns[kMotion] = evaluate(run, announced, motion(announced, {}), ignore);
  flight.columns[kBoth] = evaluate(
      run, calibrated, motion(calibrated, kGoodEnough),
      [&](const auto& /*tracker*/, const auto& result, const auto& truth) { record(result, truth, flight.ours); });
  return flight;
}

SimulatedRun flown(double run_s, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(run_s);
  scenario.errors = sim::ErrorScenario::workshop();
  scenario.stations.front().calibration.reset();  // typical values, known from OOTX except for the workshop errors
  scenario.trajectory = sim::make_random_manoeuvre({}, run_s, sim::RandomStream(seed, "table 2"));
  return SimulatedRun(std::move(scenario), seed);
}

// Adds a row whose figure is `value` of each column's run.
template <class Value>
void add_row(const std::string& what, const char* unit, const std::string& published,
             const std::array<DynamicRun, kColumns>& columns, const std::string& remark,
             std::vector<ComparisonRow>& rows, Value&& value) {
  ComparisonRow row{"table 2",
                    what,
                    unit,
                    published,
                    value(columns[kBoth]),
                    remark,
                    FurtherColumns{value(columns[kCalibration]), value(columns[kMotion]), value(columns[kBoth])}};
  row.theirs = value(columns[kPaper]);
  rows.push_back(row);
}

double rotation_rms(const DynamicRun& run) { return run.sure.rms().rotation_deg; }
double rotation_max(const DynamicRun& run) { return run.sure.max().rotation_deg; }
double position_rms(const DynamicRun& run) { return run.sure.rms().position_mm; }
double position_max(const DynamicRun& run) { return run.sure.max().position_mm; }
double answered(const DynamicRun& run) { return run.answered_percent(); }

void add_run_rows(std::size_t run, const std::array<DynamicRun, kColumns>& columns, std::vector<ComparisonRow>& rows) {
  const PublishedRun published = run < kPublishedRuns ? kTable2[run] : PublishedRun{"", "", "", ""};
  const std::string name = "run " + std::to_string(run + 1) + ": ";
  const DynamicRun& theirs = columns[kPaper];
  const std::string counts = "theirs: " + std::to_string(theirs.sure.count()) + " cycles, " +
                             std::to_string(theirs.refused) + " without an answer, " +
                             std::to_string(theirs.sure.count() - theirs.right.count()) + " in another minimum";
  add_row(name + "rotation RMS", "deg", published.rotation_rms_deg, columns, counts, rows, rotation_rms);
  add_row(name + "rotation maximum", "deg", published.rotation_max_deg, columns, "", rows, rotation_max);
  add_row(name + "position RMS", "mm", published.position_rms_mm, columns, "", rows, position_rms);
  add_row(name + "position maximum", "mm", published.position_max_mm, columns, "", rows, position_max);
  add_row(name + "answered, one pose", "%", "", columns, "", rows, answered);
}

// The rest of the table in a shorter campaign: published figures, and why there is nothing beside them.
void add_runs_left_out(std::size_t flown, std::vector<ComparisonRow>& rows) {
  for (std::size_t run = flown; run < kPublishedRuns; ++run) {
    const std::string name = "run " + std::to_string(run + 1) + ": ";
    const auto add = [&](const char* what, const char* unit, const char* published) {
      rows.push_back({"table 2", name + what, unit, published, std::nullopt, "left out by --quick"});
    };
    add("rotation RMS", "deg", kTable2[run].rotation_rms_deg);
    add("rotation maximum", "deg", kTable2[run].rotation_max_deg);
    add("position RMS", "mm", kTable2[run].position_rms_mm);
    add("position maximum", "mm", kTable2[run].position_max_mm);
  }
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

// The published runs together: root mean square of their RMS (equally long), and the largest.
std::string published_rms(const char* PublishedRun::*value) {
  double squares = 0.0;
  for (const PublishedRun& run : kTable2) squares += std::pow(std::strtod(run.*value, nullptr), 2);
  return text_of(std::sqrt(squares / kPublishedRuns));
}
std::string published_max(const char* PublishedRun::*value) {
  double largest = 0.0;
  for (const PublishedRun& run : kTable2) largest = std::max(largest, std::strtod(run.*value, nullptr));
  return text_of(largest);
}
std::string published_median(const char* PublishedRun::*value) {
  std::vector<double> all;
  for (const PublishedRun& run : kTable2) all.push_back(std::strtod(run.*value, nullptr));
  std::sort(all.begin(), all.end());
  return text_of(0.5 * (all[kPublishedRuns / 2 - 1] + all[kPublishedRuns / 2]));
}

// Every answer of every run.
void add_all_runs(const std::vector<Flight>& flights, std::vector<ComparisonRow>& rows) {
  std::array<DynamicRun, kColumns> all;
  DynamicRun from_truth;
  for (const Flight& flight : flights) {
    for (std::size_t column = 0; column < kColumns; ++column) all[column].add(flight.columns[column]);
    from_truth.add(flight.from_truth);
  }
  const std::string name = "all runs: ";
  add_row(name + "rotation RMS", "deg", published_rms(&PublishedRun::rotation_rms_deg), all,
          "published: of the printed RMS", rows, rotation_rms);
  add_row(name + "rotation maximum", "deg", published_max(&PublishedRun::rotation_max_deg), all, "", rows,
          rotation_max);
  add_row(name + "position RMS", "mm", published_rms(&PublishedRun::position_rms_mm), all, "", rows, position_rms);
  add_row(name + "position maximum", "mm", published_max(&PublishedRun::position_max_mm), all, "", rows, position_max);
  add_row(name + "answered, one pose", "%", "", all, "", rows, answered);
  const auto theirs_alone = [&](const std::string& what, const char* unit, double value, const std::string& remark) {
    ComparisonRow row{"table 2", name + what, unit, "", std::nullopt, remark};
    row.theirs = value;
    rows.push_back(row);
  };
  theirs_alone("answers more than 10 deg off", "%", all[kPaper].wrong_percent(), "another minimum fits better");
  theirs_alone("rotation RMS without those", "deg", all[kPaper].right.rms().rotation_deg, "");
  theirs_alone("position RMS without those", "mm", all[kPaper].right.rms().position_mm, "");
  theirs_alone("experiment: descent begun at the true pose, rotation RMS", "deg", from_truth.sure.rms().rotation_deg,
               "what the start has to do with it");
  theirs_alone("experiment: descent begun at the true pose, rotation maximum", "deg",
               from_truth.sure.max().rotation_deg, "");
}

// Medians over the runs, of each column.
void add_medians(const std::vector<Flight>& flights, std::vector<ComparisonRow>& rows) {
  const auto add = [&](const char* what, const char* unit, const std::string& published, auto&& value) {
    std::array<double, kColumns> middle{};
    for (std::size_t column = 0; column < kColumns; ++column) {
      std::vector<double> values;
      for (const Flight& flight : flights) values.push_back(value(flight.columns[column]));
      middle[column] = median_of(values);
    }
    ComparisonRow row{"table 2",
                      std::string(what) + " (median of runs)",
                      unit,
                      published,
                      middle[kBoth],
                      "",
                      FurtherColumns{middle[kCalibration], middle[kMotion], middle[kBoth]}};
    row.theirs = middle[kPaper];
    rows.push_back(row);
  };
  add("rotation RMS", "deg", published_median(&PublishedRun::rotation_rms_deg), rotation_rms);
  add("position RMS", "mm", published_median(&PublishedRun::position_rms_mm), position_rms);
  add("answered, one pose", "%", "", answered);
}

}  // namespace

report::PartResult reproduce_dynamic_runs(const DynamicRunsOptions& options, const std::filesystem::path& folder) {
  Progress progress("table 2", "runs", static_cast<std::size_t>(options.runs));
  report::PartResult result;
  std::vector<Flight> flights;
  for (std::size_t i = 0; i < static_cast<std::size_t>(options.runs); ++i) {
    const SimulatedRun run = flown(options.run_s, options.seed + i);
    flights.push_back(fly_by_all_methods(run, options.calibration, options.seed + i));
    add_run_rows(i, flights.back().columns, result.rows);
    if (i == 0 && !folder.empty()) add_flight_pictures(flights[0].theirs, flights[0].ours, folder, result);
    flights.back().theirs.clear();
    flights.back().ours.clear();
    progress.step();
  }
  add_runs_left_out(flights.size(), result.rows);
  if (flights.empty()) return result;
  add_all_runs(flights, result.rows);
  add_medians(flights, result.rows);
  return result;
}

}  // namespace pharos::tools
