// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/ring2/add_reproduce_ring2.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/evaluation/reproduce/ring2/sweeps.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Ellipses are projected without an image; the paper's curves are lost, its words stand in `published`.\n\n"
    "Example: pharos reproduce ring2 --markdown";

struct Options {
  int problems = 400;
  std::uint64_t seed = 1;
  bool markdown = false;
  OutputOptions output;
};

int run(const Options& options) {
  require_writable(options.output.path);
  std::vector<ComparisonRow> rows = reproduce_ring2_sweeps(options.seed).rows;
  for (const ComparisonRow& row : reproduce_ring2_noise(options.problems, options.seed)) rows.push_back(row);
  write_comparison(rows, options.markdown, options.output);
  return kExitAnswered;
}

}  // namespace

void add_reproduce_ring2(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("ring2", "Paper 001: figures 7 to 10, and what noise does");
  const auto options = std::make_shared<Options>();
  command->add_option("--problems", options->problems, "Random attitudes of each noise level")
      ->check(CLI::Range(10, 100'000))
      ->capture_default_str();
  add_seed_option(*command, options->seed, "Of attitudes and noise");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
