// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/slam_parts.hpp"

#include <utility>

#include "tools/evaluation/reproduce/slam/colour_pairs.hpp"
#include "tools/evaluation/reproduce/slam/figure_four.hpp"
#include "tools/evaluation/reproduce/slam/table_one.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

using Runs = std::vector<std::string>;

constexpr double kQuickTurn_deg = 30.0;

// Quick: without the runs that need a longer turn, or are ours alone.
Runs runs_of(const Runs& runs, const report::PartSettings& settings) {
  Runs selected;
  for (const std::string& run : runs) {
    if (!settings.quick || (!run.ends_with("-no-loops") && run != "low")) selected.push_back(run);
  }
  return selected;
}

std::string command(const Runs& runs, const report::PartSettings& settings) {
  std::string text = "pharos reproduce slam --seed " + std::to_string(settings.seed);
  if (settings.quick) text += " --turns 30 --renderer rays";
  text += " --runs";
  for (const std::string& run : runs_of(runs, settings)) text += " " + run;
  return text;
}

report::PartResult run(const Runs& runs, const std::string& light, const report::PartSettings& settings,
                       const std::filesystem::path& folder) {
  TableOneOptions options;
  options.runs = runs_of(runs, settings);
  options.seed = settings.seed;
  options.folder = folder;
  if (settings.quick) {
    options.turns_deg = {kQuickTurn_deg};
    options.povray = false;
    options.video_bm3d = true;
  }
  Progress progress("paper 004, " + light, "pairs", table_one_pairs(options));
  options.step = [&progress](std::size_t pairs) { progress.step(pairs); };
  report::PartResult result = reproduce_table_one(options);
  if (settings.quick) {
    for (const ComparisonRow& row : table_one_left_out(light == "good light", options.turns_deg)) {
      result.rows.push_back(row);
    }
  }
  return result;
}

report::Part part_of(const std::string& id, const Runs& runs, const std::string& light) {
  return {id, [runs](const report::PartSettings& settings) { return command(runs, settings); },
          [runs, light](const report::PartSettings& settings, const std::filesystem::path& folder) {
            return run(runs, light, settings, folder);
          }};
}

}  // namespace

std::vector<report::Part> slam_parts() {
  return {part_of("slam-good", {"good", "good-20-keyframes", "good-15-boards", "good-no-loops"}, "good light"),
          part_of("slam-low", {"low-enhanced", "low-bm3d", "low-enhanced-no-loops", "low"}, "low light"),
          {"slam-enhance",
           [](const report::PartSettings& settings) {
             return "pharos reproduce slam --figure4 --seed " + std::to_string(settings.seed);
           },
           [](const report::PartSettings& settings, const std::filesystem::path& folder) {
             report::PartResult result = reproduce_figure_four(settings.seed, folder);
             const report::PartResult colour = reproduce_colour_pairs(settings.seed, folder);
             result.rows.insert(result.rows.end(), colour.rows.begin(), colour.rows.end());
             result.pictures.insert(result.pictures.end(), colour.pictures.begin(), colour.pictures.end());
             return result;
           }}};
}

}  // namespace pharos::tools
