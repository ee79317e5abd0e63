// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/static_sets.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/lighthouse/paper_tracker.hpp"
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"
#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"
#include "tools/plot/curves.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr double kMaxIncidence_deg = 60.0;  // the simulator's default: largest incidence of a lit sensor

// One method's poses of one set.
struct Spreads {
  int frames = 0;
  int refused = 0;
  int ambiguous = 0;
  double observations = 0.0;  // mean over frames
  PoseSpread predicted;       // (24)
  PoseSpread measured;        // (23)
  bool answered() const { return frames > refused; }
};

struct StaticSet {
  double range_m = 0.0;
  Spreads theirs, ours;
  std::vector<int> iterations;  // theirs, of each frame
  std::vector<int> iterations_from_rpnp;
  int started_by_dlt = 0;
};

track::TrackOptions each_cycle_alone() {
  track::TrackOptions options;
  options.solve.rho = kPaperRho;
  options.smooth_flashes = false;
  return options;
}

// `each` sees the tracker after every frame with a pose.
template <class Tracker, class Each>
Spreads spreads_of(const SimulatedRun& run, Tracker& tracker, Each&& each) {
  Spreads out;
  std::vector<LighthouseFromBody> poses;
  double adop = 0.0;
  double pdop = 0.0;
  run.feed(tracker, run.as_announced(), [&](const track::EpochResult& result, const LighthouseFromBody&) {
    ++out.frames;
    if (!result.pose) {
      ++out.refused;
      return;
    }
    if (result.pose->ambiguous()) ++out.ambiguous;
    poses.push_back(result.pose->pose);
    adop += result.pose->adop_deg_per_rad;
    pdop += result.pose->pdop_m_per_rad;
    out.observations += result.observations;
    each();
  });
  if (poses.empty()) return out;
  const auto count = static_cast<double>(poses.size());
  out.observations /= count;
  out.predicted = {adop / count * kPaperSigma_rad, pdop / count * kPaperSigma_rad * kMmPerM};
  out.measured = spread_of(poses);
  return out;
}

StaticSet run_set(const sim::RoomFromBody& pose, double set_s, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(set_s);
  scenario.trajectory =
      std::make_shared<sim::StationaryTrajectory>(std::vector<sim::RoomFromBody>{pose}, 2.0 * set_s, 0.0);
  const SimulatedRun run(std::move(scenario), seed);
  const Target& target = run.simulator().nominal_target();
  StaticSet set;
  set.range_m = pose.t.norm();
  const auto theirs = std::make_unique<paper002::PaperTracker>(target, kPaperRho);
  set.theirs = spreads_of(run, *theirs, [&] {
    set.iterations.push_back(theirs->last()->iterations);
    set.started_by_dlt += theirs->last()->started_by_dlt ? 1 : 0;
    if (!theirs->last()->started_by_dlt) set.iterations_from_rpnp.push_back(theirs->last()->iterations);
  });
  const auto ours = std::make_unique<track::EpochTracker>(target, each_cycle_alone());
  set.ours = spreads_of(run, *ours, [] {});
  return set;
}

void write_sets(const std::vector<StaticSet>& sets, const std::string& path) {
  Output output({false, path}, {"set", "range_m", "frames", "refused", "ambiguous", "observations", "predicted_rot_deg",
                                "measured_rot_deg", "predicted_pos_mm", "measured_pos_mm", "paper_predicted_rot_deg",
                                "paper_measured_rot_deg", "paper_predicted_pos_mm", "paper_measured_pos_mm"});
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Spreads& ours = sets[i].ours;
    host::RowWriter& rows = output.rows();
    rows.integer(static_cast<std::int64_t>(i) + 1).number(sets[i].range_m).integer(ours.frames).integer(ours.refused);
    rows.integer(ours.ambiguous).number(ours.observations);
    for (const Spreads* one : {&sets[i].ours, &sets[i].theirs}) {
      rows.number(one->predicted.rotation_deg).number(one->measured.rotation_deg);
      rows.number(one->predicted.position_mm).number(one->measured.position_mm);
    }
    rows.end_row();
  }
  output.finish();
}

std::string range_text(const std::vector<double>& values) {
  std::array<char, 64> text;
  const int size =
      std::snprintf(text.data(), text.size(), "%.3g to %.3g", quantile_of(values, 0.05), quantile_of(values, 0.95));
  return {text.data(), static_cast<std::size_t>(size)};
}

// A figure of each answered set, by one method.
template <class Value>
std::vector<double> of_sets(const std::vector<StaticSet>& sets, Spreads StaticSet::*method, Value&& value) {
  std::vector<double> values;
  for (const StaticSet& set : sets) {
    if ((set.*method).answered()) values.push_back(value(set.*method));
  }
  return values;
}

template <class Value>
ComparisonRow row_of(const std::vector<StaticSet>& sets, const char* item, const std::string& what, const char* unit,
                     const char* published, const std::string& remark, Value&& value) {
  const std::vector<double> theirs = of_sets(sets, &StaticSet::theirs, value);
  const std::vector<double> ours = of_sets(sets, &StaticSet::ours, value);
  ComparisonRow row{item, what + " (median of sets)", unit, published, std::nullopt, remark};
  if (!ours.empty()) row.ours = median_of(ours);
  if (!theirs.empty()) row.theirs = median_of(theirs);
  if (!ours.empty() && !theirs.empty()) {
    row.remark += "5 to 95 % of sets: theirs " + range_text(theirs) + ", ours " + range_text(ours);
  }
  return row;
}

void add_iterations(const std::vector<StaticSet>& sets, std::vector<ComparisonRow>& rows) {
  constexpr int kPublishedIterations = 4;
  std::vector<double> all, from_rpnp;
  std::ptrdiff_t few = 0, dlt = 0;
  for (const StaticSet& set : sets) {
    all.insert(all.end(), set.iterations.begin(), set.iterations.end());
    few += std::count_if(set.iterations.begin(), set.iterations.end(), [](int n) { return n <= kPublishedIterations; });
    dlt += set.started_by_dlt;
    from_rpnp.insert(from_rpnp.end(), set.iterations_from_rpnp.begin(), set.iterations_from_rpnp.end());
  }
  if (all.empty()) return;
  const auto percent = [&](std::ptrdiff_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(all.size());
  };
  ComparisonRow most{"figure 5",   "iterations to convergence, in most cases (90 % of frames)", "", "<= 4",
                     std::nullopt, "until a step lowers the cost by less than a millionth"};
  most.theirs = quantile_of(all, 0.9);
  ComparisonRow within{"figure 5",       "frames that converge in at most four iterations", "%", "", std::nullopt,
                       "published: most"};
  within.theirs = percent(few);
  ComparisonRow start{"figure 5", "frames started by DLT", "%", "", std::nullopt, "the others by RPnP"};
  start.theirs = percent(dlt);
  rows.insert(rows.end(), {most, within, start});
  if (from_rpnp.empty()) return;
  ComparisonRow better{"figure 5",   "experiment: iterations of the frames that RPnP starts (90 %)",
                       "",           "<= 4",
                       std::nullopt, "what the start has to do with it"};
  better.theirs = quantile_of(from_rpnp, 0.9);
  rows.push_back(better);
}

std::vector<ComparisonRow> summary(const std::vector<StaticSet>& sets) {
  int frames = 0;
  Spreads theirs, ours;
  int ambiguous_sets = 0;
  for (const StaticSet& set : sets) {
    frames += set.ours.frames;
    ours.refused += set.ours.refused;
    theirs.refused += set.theirs.refused;
    ours.ambiguous += set.ours.ambiguous;
    if (set.ours.ambiguous > 0) ++ambiguous_sets;
  }
  const std::string count = std::to_string(sets.size()) + " sets of " + std::to_string(frames) + " frames in all; ";
  std::vector<ComparisonRow> rows = {
      row_of(sets, "figure 5", "predicted (24) / measured (23) rotation sigma", "", "1", count,
             [](const Spreads& s) { return s.predicted.rotation_deg / s.measured.rotation_deg; }),
      row_of(sets, "figure 5", "predicted (24) / measured (23) position sigma", "", "1", count,
             [](const Spreads& s) { return s.predicted.position_mm / s.measured.position_mm; }),
      row_of(sets, "section 4.2", "rotation precision (23)", "deg", "0.1", "published: order of 0.1 deg; ",
             [](const Spreads& s) { return s.measured.rotation_deg; }),
      row_of(sets, "section 4.2", "position precision (23)", "mm", "1", "published: order of mm; ",
             [](const Spreads& s) { return s.measured.position_mm; }),
  };
  ComparisonRow refused{
      "section 4.2", "frames refused", "", "", static_cast<double>(ours.refused), "of " + std::to_string(frames)};
  refused.theirs = theirs.refused;
  rows.push_back(refused);
  rows.push_back({"section 4.2", "frames flagged ambiguous", "", "", static_cast<double>(ours.ambiguous),
                  "in " + std::to_string(ambiguous_sets) + " sets; counted in the spread like all others"});
  add_iterations(sets, rows);
  return rows;
}

// Figure 5: each set's precision, measured and predicted.
void add_picture(const std::vector<StaticSet>& sets, const std::filesystem::path& folder, report::PartResult& result) {
  CurvePanel rotation{"rotation precision, deg", {}}, position{"position precision, mm", {}};
  const auto add = [&](CurvePanel& panel, const char* name, const char* colour, bool dots, auto&& value) {
    Curve curve{name, colour, {}, dots};
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (sets[i].theirs.answered()) curve.points.push_back({static_cast<double>(i) + 1.0, value(sets[i])});
    }
    panel.curves.push_back(curve);
  };
  add(rotation, "measured", "#3c82dc", false, [](const StaticSet& s) { return s.theirs.measured.rotation_deg; });
  add(rotation, "predicted", "#e1501e", true, [](const StaticSet& s) { return s.theirs.predicted.rotation_deg; });
  add(rotation, "ours, measured", "#00a060", true, [](const StaticSet& s) { return s.ours.measured.rotation_deg; });
  add(position, "measured", "#3c82dc", false, [](const StaticSet& s) { return s.theirs.measured.position_mm; });
  add(position, "predicted", "#e1501e", true, [](const StaticSet& s) { return s.theirs.predicted.position_mm; });
  add(position, "ours, measured", "#00a060", true, [](const StaticSet& s) { return s.ours.measured.position_mm; });
  write_curves((folder / "figure5.svg").string(), {rotation, position}, "set");
  result.pictures.push_back(
      {"figure 5", "each set by the paper's method, measured by (23), predicted by (24); ours", "figure5.svg"});
}

}  // namespace

report::PartResult reproduce_static_sets(const StaticSetsOptions& options, const std::filesystem::path& folder) {
  sim::RandomStationaryPoses limits;
  limits.count = options.sets;
  limits.min_range_m = 1.0;
  limits.max_range_m = 4.0;
  const auto poses = sim::random_stationary_poses(limits, paper_scenario(1.0).target, kMaxIncidence_deg,
                                                  sim::RandomStream(options.seed, "figure 5"));
  Progress progress("figure 5", "sets", poses.size());
  std::vector<StaticSet> sets;
  for (const sim::RoomFromBody& pose : poses) {
    sets.push_back(run_set(pose, options.set_s, options.seed + sets.size()));
    progress.step();
  }
  if (!options.sets_file.empty()) write_sets(sets, options.sets_file);
  report::PartResult result{summary(sets), {}};
  if (!folder.empty()) add_picture(sets, folder, result);
  return result;
}

}  // namespace pharos::tools
