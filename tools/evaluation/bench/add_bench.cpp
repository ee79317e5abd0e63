// SPDX-License-Identifier: Apache-2.0
// pharos bench: speed and accuracy compared with peers, in one run.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "tools/evaluation/bench/bench_decode.hpp"
#include "tools/evaluation/bench/bench_ellipses.hpp"
#include "tools/evaluation/bench/bench_enhance.hpp"
#include "tools/evaluation/bench/bench_fusion.hpp"
#include "tools/evaluation/bench/bench_motion.hpp"
#include "tools/evaluation/bench/bench_network.hpp"
#include "tools/evaluation/bench/bench_pose.hpp"
#include "tools/evaluation/bench/bench_target.hpp"
#include "tools/evaluation/bench/bench_tof.hpp"
#include "tools/support/commands.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos bench pose --csv\n"
    "  pharos bench target --edges recording.edges.csv.gz\n"
    "ratio: how many times better ours is than the peer's in the same run. Times are medians over the problems of the\n"
    "least of nine repeats.\n"
    "target: what the soft core spends, counted by programs that run on its instruction set under QEMU (built by the\n"
    "target `firmware`); the same in every run. The host's figures beside them are times.";

struct Options {
  std::string what = "all";
  std::string edges;
  std::optional<int> problems;
  std::string images;
  bool by_sensors = false;
  bool sweep = false;
  bool csv = false;
  bool json = false;
};

BenchForm form_of(const Options& options) {
  return options.json ? BenchForm::kJson : options.csv ? BenchForm::kCsv : BenchForm::kPretty;
}

int run_target(const Options& options) {
  TargetBench target{options.edges, options.images};
  if (options.problems) target.problems = *options.problems;
  write_target_rows(options.by_sensors ? bench_target_by_sensors(target) : bench_target(target), form_of(options));
  return kExitAnswered;
}

constexpr int kImages = 100;

std::vector<BenchRow> run_enhance(const Options& options) {
  EnhanceBench bench;
  if (!options.images.empty()) bench.images = options.images;
  if (options.problems) bench.pairs = *options.problems;
  return bench_enhance(bench);
}

int run(const Options& options) {
  constexpr int kProblems = 2000;
  if (options.sweep) {
    write_threshold_sweep(options.problems.value_or(kImages), form_of(options));
    return kExitAnswered;
  }
  if (options.what == "target") return run_target(options);
  if (options.what == "enhance") {
    write_rows(run_enhance(options), form_of(options));
    return kExitAnswered;
  }
  if (options.what == "tof") {
    write_rows(bench_tof(options.problems.value_or(kImages), load_edge_drawing()), form_of(options));
    return kExitAnswered;
  }
  std::vector<BenchRow> rows;
  const auto append = [&](const std::vector<BenchRow>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  const auto wanted = [&](const char* what) { return options.what == "all" || options.what == what; };
  if (wanted("pose")) append(bench_pose(options.problems.value_or(kProblems)));
  if (wanted("ellipses")) append(bench_ellipses(options.problems.value_or(kImages), load_edge_drawing()));
  if (wanted("decode")) append(bench_decode(options.edges));
  if (wanted("motion")) append(bench_motion());
  if (wanted("network")) append(bench_network());
  if (wanted("fusion")) append(bench_fusion());
  write_rows(rows, form_of(options));
  return kExitAnswered;
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Speed and accuracy, ours and peers', as ratios in one run");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("what", options->what,
                   "pose, ellipses, decode, motion, network, fusion, all of these (default), enhance, tof: a depth "
                   "frame's stages, or "
                   "target: the soft core")
      ->check(CLI::IsMember(
          {"all", "pose", "ellipses", "decode", "motion", "network", "fusion", "enhance", "tof", "target"}));
  command->add_option("--edges", options->edges, "Recording to decode; default: a simulated minute of twelve sensors");
  command
      ->add_option("--problems", options->problems,
                   "Pose problems (2000; target 200), images a set, depth frames (100), pairs of views (20)")
      ->check(CLI::Range(10, 1'000'000));
  command->add_option("--images", options->images,
                      "target: folder of the images (the build's, or the installed one); enhance: of opencv-doc's");
  command->add_flag("--sensors", options->by_sensors, "target: how the figures grow from 4 to 32 sensors");
  command->add_flag("--sweep", options->sweep, "ellipses: recall and precision over thresholds of the score (CSV)");
  auto* csv = command->add_flag("--csv", options->csv, "what,ours,peer,ratio,unit instead of aligned columns");
  command->add_flag("--json", options->json, "One JSON object a line")->excludes(csv);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
