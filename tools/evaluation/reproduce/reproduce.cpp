// SPDX-License-Identifier: Apache-2.0
// pharos reproduce: the papers' tables and figures, published and ours.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>

#include "tools/evaluation/reproduce/add_reproduce_all.hpp"
#include "tools/evaluation/reproduce/fusion/add_reproduce_fusion.hpp"
#include "tools/evaluation/reproduce/integrity/add_reproduce_integrity.hpp"
#include "tools/evaluation/reproduce/lighthouse/lighthouse_parts.hpp"
#include "tools/evaluation/reproduce/lighthouse/recordings.hpp"
#include "tools/evaluation/reproduce/pointing/add_reproduce_pointing.hpp"
#include "tools/evaluation/reproduce/ring2/add_reproduce_ring2.hpp"
#include "tools/evaluation/reproduce/slam/add_reproduce_slam.hpp"
#include "tools/evaluation/reproduce/stations/add_reproduce_stations.hpp"
#include "tools/evaluation/reproduce/tof/add_reproduce_tof.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos reproduce lighthouse --markdown\n"
    "  pharos reproduce lighthouse --quick --sets sets.csv\n"
    "  pharos reproduce lighthouse --recordings ../shared/data/lighthouse\n"
    "Light pulses are simulated and go through the decoder, OOTX, calibration and solver as real ones do.";

struct Options {
  bool quick = false;
  bool markdown = false;
  bool real = false;
  std::string recordings;
  std::uint64_t seed = 1;
  std::string sets_file;
  OutputOptions output;
};

// --recordings DIR; else PHAROS_DATA, the folder that contains `lighthouse`.
std::string recordings_directory(const std::string& given) {
  if (!given.empty()) return given;
  const char* data = std::getenv("PHAROS_DATA");
  return (std::filesystem::path(data != nullptr ? data : "../shared/data") / "lighthouse").string();
}

std::vector<ComparisonRow> simulated_rows(const Options& options) {
  StaticSetsOptions sets;
  DynamicRunsOptions runs;
  sets.seed = runs.seed = options.seed;
  sets.sets_file = options.sets_file;
  if (options.quick) {
    make_quick(sets);
    make_quick(runs);
  }
  std::vector<ComparisonRow> rows = reproduce_static_sets(sets).rows;
  for (const ComparisonRow& row : reproduce_dynamic_runs(runs).rows) rows.push_back(row);
  return rows;
}

int run(const Options& options) {
  require_writable(options.output.path);
  if (!options.sets_file.empty()) require_writable(options.sets_file);
  const std::vector<ComparisonRow> rows =
      options.real ? measure_recordings(recordings_directory(options.recordings)) : simulated_rows(options);
  write_comparison(rows, options.markdown, options.output);
  return rows.empty() ? kExitNoAnswer : kExitAnswered;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
  CLI::App* reproduce = app.add_subcommand("reproduce", "The papers' tables: published, ours, ratio");
  reproduce->require_subcommand(1);
  reproduce->footer("Example: pharos reproduce lighthouse --quick");
  CLI::App* command =
      reproduce->add_subcommand("lighthouse", "Paper 002: figure 5, section 4.2, table 2; or recordings");
  const auto options = std::make_shared<Options>();
  command->add_flag("--quick", options->quick, "Fewer and shorter sets and runs");
  CLI::Option* recordings = command->add_option("--recordings", options->recordings,
                                                "The real recordings in DIR instead (default: PHAROS_DATA/lighthouse)");
  recordings->type_name("[DIR]")->expected(0, 1);
  add_seed_option(*command, options->seed, "Of poses, noise and errors");
  command->add_option("--sets", options->sets_file, "File for one row a set of figure 5")->check(output_place());
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, recordings, &exit_code] {
    options->real = recordings->count() > 0;
    exit_code = run(*options);
  });
  add_reproduce_all(*reproduce, exit_code);
  add_reproduce_slam(*reproduce, exit_code);
  add_reproduce_tof(*reproduce, exit_code);
  add_reproduce_pointing(*reproduce, exit_code);
  add_reproduce_ring2(*reproduce, exit_code);
  add_reproduce_integrity(*reproduce, exit_code);
  add_reproduce_stations(*reproduce, exit_code);
  add_reproduce_fusion(*reproduce, exit_code);
}

}  // namespace pharos::tools
