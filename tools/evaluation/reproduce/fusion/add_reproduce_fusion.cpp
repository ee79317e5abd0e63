// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/fusion/add_reproduce_fusion.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/evaluation/reproduce/fusion/fusion_campaign.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kFusionExample =
    "Poses of lighthouse, tof, ring2 (without roll) and slam (without origin) of a target at 2 to 2.5 m, simulated\n"
    "without light or images. A fault of 3 to 30 sigma begins at a random time in a random source; the protection\n"
    "level expects faults of that kind once an hour of each source. A look is one of 20 a second.\n\n"
    "Example:\n"
    "  pharos reproduce fusion --markdown\n"
    "  pharos reproduce fusion --runs 100 --fault ramp --fault step";

struct FusionOptions {
  FusionCampaign campaign;
  bool markdown = false;
  OutputOptions output;
};

int run_command(const FusionOptions& options) {
  require_writable(options.output.path);
  const FusionCampaign& campaign = options.campaign;
  const std::size_t kinds = campaign.faults.empty() ? fusion_fault_names().size() : campaign.faults.size();
  Progress progress(
      "reproduce fusion", "runs",
      static_cast<std::size_t>(campaign.consistency_runs) + kinds * static_cast<std::size_t>(campaign.runs));
  const std::vector<ComparisonRow> rows = run_fusion_campaign(campaign, [&] { progress.step(); });
  write_comparison(rows, options.markdown, options.output);
  return rows.empty() ? kExitNoAnswer : kExitAnswered;
}

}  // namespace

void add_reproduce_fusion(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("fusion", "Fused state: consistency, protection levels, exclusion");
  const auto options = std::make_shared<FusionOptions>();
  command->add_option("--runs", options->campaign.runs, "Runs of each kind of fault")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--consistency-runs", options->campaign.consistency_runs, "Runs without fault")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--fault", options->campaign.faults, "Only this kind of fault; may be repeated")
      ->check(CLI::IsMember(fusion_fault_names()));
  add_seed_option(*command, options->campaign.seed, "Of the first run; the next ones follow");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kFusionExample);
  command->callback([options, &exit_code] { exit_code = run_command(*options); });
}

}  // namespace pharos::tools
