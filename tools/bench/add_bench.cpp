// SPDX-License-Identifier: Apache-2.0
// pharos bench: speed and accuracy beside peers, in one run.
#include <cstdio>
#include <memory>

#include "tools/bench/bench_decode.hpp"
#include "tools/bench/bench_pose.hpp"
#include "tools/bench/peer_module.hpp"
#include "tools/cli/commands.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos bench pose --csv\n"
    "ratio: how many times better ours is than the peer's in the same run. Times are medians over the problems of the\n"
    "least of nine repeats.";

struct Options {
  std::string what = "all";
  std::string edges;
  int problems = 2000;
  bool csv = false;
  bool json = false;
};

int run(const Options& options) {
  std::vector<BenchRow> rows;
  const auto append = [&](const std::vector<BenchRow>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  if (options.what != "decode") {
    const PeerFunction peers = load_peers();
    if (peers == nullptr) {
      std::fprintf(stderr, "pharos bench: %s is not beside the program (built without OpenCV): no peers\n",
                   kPeerModuleName);
    }
    append(bench_pose(options.problems, peers));
  }
  if (options.what != "pose") append(bench_decode(options.edges));
  write_rows(rows, options.json ? BenchForm::kJson : options.csv ? BenchForm::kCsv : BenchForm::kPretty);
  return kExitAnswered;
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Speed and accuracy, ours and peers', as ratios in one run");
  const auto options = std::make_shared<Options>();
  command->add_option("what", options->what, "pose, decode or all (default)")
      ->check(CLI::IsMember({"all", "pose", "decode"}));
  command->add_option("--edges", options->edges, "Recording to decode; default: a simulated minute of twelve sensors");
  command->add_option("--problems", options->problems, "Pose problems (2000)")->check(CLI::Range(10, 1'000'000));
  auto* csv = command->add_flag("--csv", options->csv, "what,ours,peer,ratio,unit instead of aligned columns");
  command->add_flag("--json", options->json, "One JSON object a line")->excludes(csv);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
