// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/pointing/add_reproduce_pointing.hpp"

#include <memory>

#include "tools/evaluation/reproduce/pointing/attitude_tables.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct Options {
  std::uint64_t seed = 1;
  bool markdown = false;
  OutputOptions output;
};

int run(const Options& options) {
  require_writable(options.output.path);
  const std::vector<ComparisonRow> rows = reproduce_attitudes(options.seed).rows;
  write_comparison(rows, options.markdown, options.output);
  return kExitAnswered;
}

}  // namespace

void add_reproduce_pointing(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("line", "Paper 003: tables 1 and 2 (needs povray)");
  const auto options = std::make_shared<Options>();
  add_seed_option(*command, options->seed, "Of sun, stars and noise");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(
      "The four attitudes are rendered and measured by the paper's method as printed and by ours.\n\nExample: pharos "
      "reproduce line "
      "--markdown");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
