// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/add_reproduce_all.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/evaluation/report/run_report.hpp"
#include "tools/evaluation/reproduce/lighthouse/lighthouse_parts.hpp"
#include "tools/evaluation/reproduce/pointing/attitude_tables.hpp"
#include "tools/evaluation/reproduce/ring2/sweeps.hpp"
#include "tools/evaluation/reproduce/slam/slam_parts.hpp"
#include "tools/evaluation/reproduce/tof/tof_parts.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kAllExample =
    "Each paper's numbered tables and figures: published, the published method rerun, ours. DIR receives report.html\n"
    "(one page, no network), report.md, and a folder for each part. A part that is finished with the same program and\n"
    "settings is not run again: after an interruption the same command goes on where it was.\n\n"
    "Examples:\n"
    "  pharos reproduce all --output report --quick\n"
    "  pharos reproduce all --output report --only ring2 line\n"
    "  pharos reproduce all --output report --renderer rays\n"
    "  pharos reproduce all --output report --quick-parts slam-good slam-low-bm3d --results RESULTS.md";

// The shortest first: whoever waits sees something.
std::vector<report::Part> all_parts() {
  std::vector<report::Part> parts = {ring2_part(), line_part()};
  for (const auto& more : {lighthouse_parts(), tof_parts(), slam_parts()}) {
    parts.insert(parts.end(), more.begin(), more.end());
  }
  return parts;
}

std::vector<std::string> ids_of(const std::vector<report::Part>& parts) {
  std::vector<std::string> ids;
  for (const report::Part& part : parts) ids.push_back(part.id);
  return ids;
}

}  // namespace

void add_reproduce_all(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("all", "Every table and figure of the five papers, as one page");
  const auto options = std::make_shared<report::ReportOptions>();
  command->add_option("--output", options->folder, "Folder of the report")->required()->check(output_place());
  const std::vector<std::string> ids = ids_of(all_parts());
  CLI::Option* quick = command->add_flag("--quick", options->settings.quick, "Fewer and shorter runs");
  command->add_option("--quick-parts", options->quick, "These parts quick, the others whole")
      ->check(CLI::IsMember(ids))
      ->excludes(quick);
  command->add_option("--only", options->only, "These parts alone")->check(CLI::IsMember(ids));
  command->add_option("--results", options->results,
                      "A Markdown file that takes the tables too, between its lines '<!-- five papers: begin -->' and "
                      "'<!-- five papers: end -->'");
  const auto set_renderer = [options](const std::string& name) { options->settings.rays = name == "rays"; };
  command
      ->add_option_function<std::string>(
          "--renderer", set_renderer,
          "Of paper 004's images: povray (default), or rays: without gloss, in a tenth of the time")
      ->check(CLI::IsMember({"povray", "rays"}));
  add_seed_option(*command, options->settings.seed, "Of everything that is drawn at random");
  command->footer(kAllExample);
  command->callback(
      [options, &exit_code] { exit_code = report::run_report(all_parts(), *options) ? kExitAnswered : kExitNoAnswer; });
}

}  // namespace pharos::tools
