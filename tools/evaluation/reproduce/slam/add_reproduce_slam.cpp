// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/add_reproduce_slam.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/evaluation/reproduce/slam/body_campaign.hpp"
#include "tools/evaluation/reproduce/slam/colour_pairs.hpp"
#include "tools/evaluation/reproduce/slam/figure_four.hpp"
#include "tools/evaluation/reproduce/slam/table_one.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Stereo pairs of a turning satellite are rendered and tracked. With own rays and all turns each run takes some "
    "three\n"
    "minutes; with POV-Ray hours. Runs can be had one by one; together they share pictures.\n\n"
    "Example:\n"
    "  pharos reproduce slam --turns 30 60 --renderer rays --markdown\n"
    "  pharos reproduce slam --runs low-enhanced --renderer rays --output low.csv\n"
    "  pharos reproduce slam --bodies 20 --seed 101 --markdown";

struct Options {
  TableOneOptions table;
  BodyCampaign bodies;
  std::string renderer = "povray";
  bool figure4 = false;
  bool markdown = false;
  OutputOptions output;
};

int run_over_bodies(const Options& options) {
  BodyCampaign campaign = options.bodies;
  campaign.seed = options.table.seed;
  campaign.features = options.table.features;
  const auto pairs = static_cast<std::size_t>(campaign.scenario.turn_deg / campaign.scenario.step_deg) + 1;
  Progress progress("reproduce slam", "pairs", static_cast<std::size_t>(campaign.bodies) * pairs);
  campaign.step = [&progress] { progress.step(); };
  run_bodies(campaign, options.markdown, options.output);
  return kExitAnswered;
}

int run(Options options) {
  require_writable(options.output.path);
  if (options.bodies.bodies > 0) return run_over_bodies(options);
  if (options.figure4) {
    std::vector<ComparisonRow> rows = reproduce_figure_four(options.table.seed).rows;
    for (const ComparisonRow& row : reproduce_colour_pairs(options.table.seed).rows) rows.push_back(row);
    write_comparison(rows, options.markdown, options.output);
    return kExitAnswered;
  }
  options.table.povray = options.renderer == "povray";
  Progress progress("reproduce slam", "pairs", table_one_pairs(options.table));
  options.table.step = [&progress](std::size_t pairs) { progress.step(pairs); };
  const std::vector<ComparisonRow> rows = reproduce_table_one(options.table).rows;
  write_comparison(rows, options.markdown, options.output);
  return kExitAnswered;
}

}  // namespace

void add_reproduce_slam(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("slam", "Paper 004: table 1, good and low light");
  const auto options = std::make_shared<Options>();
  command->add_option("--turns", options->table.turns_deg, "Turns, deg (default 30 60 90 180 360 720)")
      ->check(CLI::Range(1.0, 7200.0));
  command->add_option("--runs", options->table.runs, "Which (default all); BM3D alone takes most of an hour")
      ->check(CLI::IsMember(table_one_runs()));
  command->add_option("--features", options->table.features, "Features a frame (default 1000)")
      ->check(CLI::Range(100, 10'000));
  command
      ->add_option("--renderer", options->renderer, "povray (default), or rays: without gloss, in a tenth of the time")
      ->check(CLI::IsMember({"povray", "rays"}));
  command
      ->add_option("--bodies", options->bodies.bodies,
                   "Instead of the table: a turn of as many satellites drawn at random, a row each, every second one "
                   "symmetric; --turn-deg and --step-deg say how")
      ->check(CLI::Range(1, 100'000));
  command->add_option("--turn-deg", options->bodies.scenario.turn_deg, "With --bodies (default 360)")
      ->check(CLI::Range(1.0, 7200.0));
  command->add_option("--step-deg,--step", options->bodies.scenario.step_deg, "With --bodies, a pair (default 1)")
      ->check(CLI::Range(0.05, 30.0));
  add_seed_option(*command, options->table.seed,
                  "Of textures, stars and noise; with --bodies of the first, the next ones follow");
  command->add_flag(
      "--figure4", options->figure4,
      "Instead: figure 4, LIME beside BIMEF, Dong's method, MSRCR and SRIE in the dark, grey and in colour");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
