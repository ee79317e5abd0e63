// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/fusion/fusion_campaign.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "pharos/base/units.hpp"
#include "pharos/fusion/words.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_run.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"

namespace pharos::tools {
namespace {

constexpr double kMinSize = 3.0;  // sigmas
constexpr double kMaxSize = 30.0;
constexpr double kFaultsPerHour = 1.0;

double ratio(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

double root(double sum, std::size_t count) { return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0; }

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Fault-free runs, with the sources' delays.
std::vector<ComparisonRow> consistency(const FusionCampaign& campaign, const std::function<void()>& step) {
  RunFigures sum;
  double largest_hand_over = 0.0;
  for (int run = 0; run < campaign.consistency_runs; ++run) {
    const sim::WorldSettings world = close_range_world(campaign.seed + static_cast<std::uint64_t>(run));
    const RunFigures one = run_fusion(world, settings_of(world, 1e-3));
    sum.looks += one.looks;
    sum.answered += one.answered;
    sum.protected_looks += one.protected_looks;
    sum.outside += one.outside;
    sum.wrong_excluded += one.wrong_excluded;
    sum.fused += one.fused;
    sum.settled += one.settled;
    sum.settled_levels += one.settled_levels;
    sum.pose_nees += one.pose_nees;
    sum.rate_nees += one.rate_nees;
    sum.position_m2 += one.position_m2;
    sum.rotation_rad2 += one.rotation_rad2;
    sum.velocity_m2_s2 += one.velocity_m2_s2;
    sum.rate_rad2_s2 += one.rate_rad2_s2;
    sum.level_position_m += one.level_position_m;
    sum.level_rotation_rad += one.level_rotation_rad;
    largest_hand_over = std::max(largest_hand_over, one.counters.largest_hand_over_sigma);
    step();
  }
  const std::string item = "no fault";
  const double settled = static_cast<double>(std::max<std::size_t>(1, sum.settled));
  const double levels = static_cast<double>(std::max<std::size_t>(1, sum.settled_levels));
  const std::string runs = std::to_string(campaign.consistency_runs) + " runs";
  return {{item, "NEES of the pose / 6", "", "0.9 to 1.1", sum.pose_nees / (6.0 * settled), runs},
          {item, "NEES of the rates / 6", "", "0.9 to 1.1", sum.rate_nees / (6.0 * settled), runs},
          {item, "position RMS", "mm", "", root(sum.position_m2, sum.settled) * kMmPerM, ""},
          {item, "rotation RMS", "deg", "", root(sum.rotation_rad2, sum.settled) * kDegPerRad, ""},
          {item, "velocity RMS", "mm/s", "<= 3", root(sum.velocity_m2_s2, sum.settled) * kMmPerM, ""},
          {item, "angular rate RMS", "deg/s", "<= 0.05", root(sum.rate_rad2_s2, sum.settled) * kDegPerRad, ""},
          {item, "protection level, position", "mm", "<= 20", sum.level_position_m / levels * kMmPerM,
           "mean, 2 m to 2.5 m"},
          {item, "protection level, rotation", "deg", "<= 0.5", sum.level_rotation_rad / levels * kDegPerRad, "mean"},
          {item, "truth outside the level", "", "0", static_cast<double>(sum.outside),
           "of " + std::to_string(sum.protected_looks) + " looks"},
          {item, "looks with a level", "%", "", 100.0 * ratio(sum.protected_looks, sum.looks), ""},
          {item, "looks with a state", "%", ">= 99.5", 100.0 * ratio(sum.answered, sum.looks), "from the first one on"},
          {item, "looks with a source excluded", "%", "<= 0.1", 100.0 * ratio(sum.wrong_excluded, sum.looks), ""},
          {item, "largest step at a hand-over", "sigma", "<= 1", largest_hand_over, ""}};
}

sim::WorldSettings faulty_world(std::uint64_t seed, std::size_t kind) {
  sim::WorldSettings world = close_range_world(seed);
  world.duration_s = 25.0;
  // Measurements in order: that late ones change nothing is shown elsewhere, and costs ten times the time here.
  for (sim::MeasuredSource& source : world.sources) source.delay_s = 0.001;
  sim::RandomStream random(seed, "fusion campaign");
  world.fault.kind = static_cast<sim::SourceFaultKind>(kind + 1);
  world.fault.source = static_cast<std::size_t>(random.below(static_cast<int>(world.sources.size())));
  world.fault.from_s = random.uniform(7.0, 12.0);
  world.fault.size = random.uniform(kMinSize, kMaxSize);
  if (random.chance(0.5)) world.fault.until_s = world.fault.from_s + random.uniform(2.0, 8.0);
  return world;
}

std::string reasons_text(const std::array<int, fusion::kFaultKinds>& reasons) {
  std::string text;
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    if (reasons[k] > 0)
      text += (text.empty() ? "" : "; ") + std::string(fusion::kFaultWords[k]) + " " + std::to_string(reasons[k]);
  }
  return text.empty() ? "" : "reasons: " + text;
}

std::vector<ComparisonRow> faulty(const FusionCampaign& campaign, std::size_t kind, const std::function<void()>& step) {
  std::size_t looks = 0, levels = 0, position_levels = 0, wrong = 0, conflicts = 0;
  int outside = 0, excluded = 0, in_conflict = 0, neither = 0, wrong_runs = 0;
  double largest = 0.0, largest_unnoticed = 0.0;
  std::string outside_seeds;
  std::vector<double> after_s;
  std::array<int, fusion::kFaultKinds> reasons{};
  for (int run = 0; run < campaign.runs; ++run) {
    const std::uint64_t seed = campaign.seed + static_cast<std::uint64_t>(run);
    const sim::WorldSettings world = faulty_world(seed, kind);
    fusion::Settings settings = settings_of(world, 0.0);
    for (fusion::SourceSettings& source : settings.sources) source.faults_per_hour[kind] = kFaultsPerHour;
    const RunFigures one = run_fusion(world, settings);
    looks += one.looks;
    levels += one.protected_looks;
    position_levels += one.position_levels;
    wrong += one.wrong_excluded;
    conflicts += one.conflict;
    wrong_runs += one.wrong_excluded > 0 ? 1 : 0;
    largest = std::max(largest, one.largest_ratio);
    if (one.outside > 0) {
      ++outside;
      outside_seeds += " " + std::to_string(seed);
    }
    if (one.excluded_after_s) {
      ++excluded;
      after_s.push_back(*one.excluded_after_s);
      ++reasons[static_cast<std::size_t>(*one.reason)];
    } else if (one.conflict_after_s) {
      ++in_conflict;
      after_s.push_back(*one.conflict_after_s);
    } else {
      ++neither;
      largest_unnoticed = std::max(largest_unnoticed, one.largest_ratio);
    }
    step();
  }
  const std::string item = fusion::kFaultWords[kind];
  // Clopper-Pearson for zero of n: 1 - 0.05^(1/n); for more the table tells the seeds.
  const double limit = outside == 0 ? 100.0 * (1.0 - std::pow(0.05, 1.0 / std::max(1, campaign.runs))) : 0.0;
  std::array<char, 32> limit_text{};
  std::snprintf(limit_text.data(), limit_text.size(), "%.2g", limit);
  const std::string of_runs = "of " + std::to_string(campaign.runs);
  return {{item, "runs with the truth outside the level", "", "0", static_cast<double>(outside),
           outside == 0 ? of_runs + "; 95 % limit " + limit_text.data() + " %" : of_runs + "; seeds" + outside_seeds},
          {item, "largest error over level", "", "< 1", largest, ""},
          {item, "runs: faulty source excluded", "", "", static_cast<double>(excluded), reasons_text(reasons)},
          {item, "runs: conflict", "", "", static_cast<double>(in_conflict), "not excluded before"},
          {item, "runs: neither", "", "", static_cast<double>(neither), "within the level"},
          {item, "time to exclusion or conflict, median", "s", "", median(after_s), ""},
          {item, "looks with a right source excluded", "%", "<= 0.1", 100.0 * ratio(wrong, looks),
           "in " + std::to_string(wrong_runs) + " runs"},
          {item, "looks in conflict", "%", "", 100.0 * ratio(conflicts, looks), ""},
          {item, "looks with a level of the position", "%", "", 100.0 * ratio(position_levels, looks), ""},
          {item, "looks with levels of both", "%", "", 100.0 * ratio(levels, looks), ""}};
}

}  // namespace

std::vector<std::string> fusion_fault_names() { return {fusion::kFaultWords.begin(), fusion::kFaultWords.end()}; }

std::vector<ComparisonRow> run_fusion_campaign(const FusionCampaign& campaign, const std::function<void()>& step) {
  std::vector<ComparisonRow> rows;
  if (campaign.consistency_runs > 0) rows = consistency(campaign, step);
  for (std::size_t kind = 0; kind < fusion::kFaultKinds; ++kind) {
    const bool wanted = campaign.faults.empty() || std::find(campaign.faults.begin(), campaign.faults.end(),
                                                             fusion::kFaultWords[kind]) != campaign.faults.end();
    if (!wanted || campaign.runs == 0) continue;
    for (const ComparisonRow& row : faulty(campaign, kind, step)) rows.push_back(row);
  }
  return rows;
}

}  // namespace pharos::tools
