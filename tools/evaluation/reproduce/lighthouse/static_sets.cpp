// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/static_sets.hpp"

#include <array>
#include <cstdio>
#include <memory>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/lighthouse/pose_spread.hpp"
#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr double kMaxIncidence_deg = 60.0;  // the simulator's default: largest incidence of a lit sensor

struct StaticSet {
  int frames = 0;
  int refused = 0;
  int ambiguous = 0;
  double range_m = 0.0;
  double observations = 0.0;  // mean over frames
  PoseSpread predicted;       // (24)
  PoseSpread measured;        // (23)
};

track::TrackOptions static_paper_method() {
  track::TrackOptions options;
  options.solve.rho = kPaperRho;
  options.smooth_flashes = false;
  return options;
}

StaticSet run_set(const sim::RoomFromBody& pose, double set_s, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(set_s);
  scenario.trajectory =
      std::make_shared<sim::StationaryTrajectory>(std::vector<sim::RoomFromBody>{pose}, 2.0 * set_s, 0.0);
  const SimulatedRun run(std::move(scenario), seed);
  StaticSet set;
  set.range_m = pose.t.norm();
  std::vector<LighthouseFromBody> poses;
  double adop = 0.0;
  double pdop = 0.0;
  run.track(static_paper_method(), [&](const track::EpochResult& result, const LighthouseFromBody&) {
    ++set.frames;
    if (!result.pose) {
      ++set.refused;
      return;
    }
    if (result.pose->ambiguous()) ++set.ambiguous;
    poses.push_back(result.pose->pose);
    adop += result.pose->adop_deg_per_rad;
    pdop += result.pose->pdop_m_per_rad;
    set.observations += result.observations;
  });
  if (poses.empty()) return set;
  const auto count = static_cast<double>(poses.size());
  set.observations /= count;
  set.predicted = {adop / count * kPaperSigma_rad, pdop / count * kPaperSigma_rad * kMmPerM};
  set.measured = spread_of(poses);
  return set;
}

void write_sets(const std::vector<StaticSet>& sets, const std::string& path) {
  Output output({false, path}, {"set", "range_m", "frames", "refused", "ambiguous", "observations", "predicted_rot_deg",
                                "measured_rot_deg", "predicted_pos_mm", "measured_pos_mm"});
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const StaticSet& set = sets[i];
    host::RowWriter& rows = output.rows();
    rows.integer(static_cast<std::int64_t>(i) + 1).number(set.range_m).integer(set.frames).integer(set.refused);
    rows.integer(set.ambiguous).number(set.observations).number(set.predicted.rotation_deg);
    rows.number(set.measured.rotation_deg).number(set.predicted.position_mm).number(set.measured.position_mm);
    rows.end_row();
  }
  output.finish();
}

std::string range_text(const std::vector<double>& values) {
  std::array<char, 64> text;
  const int size = std::snprintf(text.data(), text.size(), "5 to 95 %% of sets: %.3g to %.3g",
                                 quantile_of(values, 0.05), quantile_of(values, 0.95));
  return {text.data(), static_cast<std::size_t>(size)};
}

std::vector<ComparisonRow> summary(const std::vector<StaticSet>& sets) {
  std::vector<double> rotation_ratio, position_ratio, rotation, position;
  int frames = 0;
  int refused = 0;
  int ambiguous = 0;
  int ambiguous_sets = 0;
  for (const StaticSet& set : sets) {
    frames += set.frames;
    refused += set.refused;
    ambiguous += set.ambiguous;
    if (set.ambiguous > 0) ++ambiguous_sets;
    if (set.frames == set.refused) continue;
    rotation_ratio.push_back(set.predicted.rotation_deg / set.measured.rotation_deg);
    position_ratio.push_back(set.predicted.position_mm / set.measured.position_mm);
    rotation.push_back(set.measured.rotation_deg);
    position.push_back(set.measured.position_mm);
  }
  if (rotation.empty()) return {{"figure 5", "sets with a pose", "", std::to_string(sets.size()), 0.0, ""}};
  const std::string remark = std::to_string(sets.size()) + " sets of " + std::to_string(frames) + " frames in all";
  return {
      {"figure 5", "predicted (24) / measured (23) rotation sigma (median of sets)", "", "1", median_of(rotation_ratio),
       remark + "; " + range_text(rotation_ratio)},
      {"figure 5", "predicted (24) / measured (23) position sigma (median of sets)", "", "1", median_of(position_ratio),
       remark + "; " + range_text(position_ratio)},
      {"section 4.2", "rotation precision (23) (median of sets)", "deg", "0.1", median_of(rotation),
       "published: order of 0.1 deg; " + range_text(rotation)},
      {"section 4.2", "position precision (23) (median of sets)", "mm", "1", median_of(position),
       "published: order of mm; " + range_text(position)},
      {"section 4.2", "frames refused", "", "", static_cast<double>(refused), "of " + std::to_string(frames)},
      {"section 4.2", "frames flagged ambiguous", "", "", static_cast<double>(ambiguous),
       "in " + std::to_string(ambiguous_sets) + " sets; counted in the spread like all others"},
  };
}

}  // namespace

std::vector<ComparisonRow> reproduce_static_sets(const StaticSetsOptions& options) {
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
  return summary(sets);
}

}  // namespace pharos::tools
