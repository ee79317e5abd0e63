// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/slam_parts.hpp"

#include <array>
#include <fstream>
#include <optional>
#include <string>

#include "host/files/atomic_file.hpp"
#include "tools/evaluation/report/store.hpp"
#include "tools/evaluation/reproduce/slam/colour_pairs.hpp"
#include "tools/evaluation/reproduce/slam/figure_four.hpp"
#include "tools/evaluation/reproduce/slam/table_one.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kQuickTurn_deg = 30.0;

struct SlamRun {
  const char* key;  // of table_one_runs(); the part is "slam-" and this
  bool good_light;
  bool first;        // says of the other turns that a quick report leaves them out
  bool whole_alone;  // needs a longer turn, or is ours alone
};
constexpr std::array<SlamRun, 8> kRuns{{{"good", true, true, false},
                                        {"good-20-keyframes", true, false, false},
                                        {"good-15-boards", true, false, false},
                                        {"good-no-loops", true, false, true},
                                        {"low-enhanced", false, true, false},
                                        {"low-bm3d", false, false, false},
                                        {"low-enhanced-no-loops", false, false, true},
                                        {"low", false, false, true}}};

const char* light_of(const SlamRun& run) { return run.good_light ? "good light" : "low light"; }

std::string command(const SlamRun& run, const report::PartSettings& settings) {
  std::string text = "pharos reproduce slam --seed " + std::to_string(settings.seed);
  if (settings.quick) text += " --turns 30";
  if (settings.quick || settings.rays) text += " --renderer rays";
  return text + " --runs " + run.key;
}

// The images of one light, beside the parts' folders: what a former program or other settings rendered is removed.
fs::path frames_of(const SlamRun& run, const report::PartSettings& settings, const fs::path& part_folder) {
  const std::string name = run.good_light ? "frames-good" : "frames-low";
  const std::string key = report::key_of(name, settings);
  const fs::path folder = part_folder.parent_path() / name, key_file = folder / "key";
  std::string there;
  if (std::ifstream file(key_file); file) std::getline(file, there);
  if (there != key) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::create_directories(folder, ignored);
    host::write_file(key_file.string(), key + "\n");
  }
  return folder;
}

report::PartResult run_part(const SlamRun& run, const report::PartSettings& settings, const fs::path& folder) {
  report::PartResult result;
  if (settings.quick && run.whole_alone) {
    result.rows.push_back(
        {"table 1, " + std::string(light_of(run)), run.key, "", "", std::nullopt, "left out by --quick"});
    return result;
  }
  TableOneOptions options;
  options.runs = {run.key};
  options.seed = settings.seed;
  options.folder = folder;
  options.frames = frames_of(run, settings, folder);
  options.povray = !settings.quick && !settings.rays;
  if (settings.quick) {
    options.turns_deg = {kQuickTurn_deg};
    options.video_bm3d = true;
  }
  Progress progress("paper 004, " + std::string(run.key), "pairs", table_one_pairs(options));
  options.step = [&progress](std::size_t pairs) { progress.step(pairs); };
  result = reproduce_table_one(options);
  if (settings.quick && run.first) {
    for (const ComparisonRow& row : table_one_left_out(run.good_light, options.turns_deg)) result.rows.push_back(row);
  }
  return result;
}

report::Part enhance_part() {
  return {"slam-enhance",
          [](const report::PartSettings& settings) {
            return "pharos reproduce slam --figure4 --seed " + std::to_string(settings.seed);
          },
          [](const report::PartSettings& settings, const fs::path& folder) {
            report::PartResult result = reproduce_figure_four(settings.seed, folder);
            const report::PartResult colour = reproduce_colour_pairs(settings.seed, folder);
            result.rows.insert(result.rows.end(), colour.rows.begin(), colour.rows.end());
            result.pictures.insert(result.pictures.end(), colour.pictures.begin(), colour.pictures.end());
            return result;
          }};
}

}  // namespace

std::vector<report::Part> slam_parts() {
  std::vector<report::Part> parts;
  for (const SlamRun& run : kRuns) {
    parts.push_back({std::string("slam-") + run.key,
                     [&run](const report::PartSettings& settings) { return command(run, settings); },
                     [&run](const report::PartSettings& settings, const fs::path& folder) {
                       return run_part(run, settings, folder);
                     }});
  }
  parts.push_back(enhance_part());
  return parts;
}

}  // namespace pharos::tools
