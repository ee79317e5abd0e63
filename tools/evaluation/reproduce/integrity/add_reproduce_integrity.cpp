// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/add_reproduce_integrity.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "host/support/input_error.hpp"
#include "tools/evaluation/reproduce/integrity/campaign.hpp"
#include "tools/sim/optics/tone_curve.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "A seed is a body, its light, its cameras and their noise. An integrity failure is an answer with the status ok\n"
    "that is beyond 5 of its own sigmas and beyond 1 deg or 10 mm.\n\n"
    "Example:\n"
    "  pharos reproduce integrity --markdown\n"
    "  pharos reproduce integrity --kind ring2 --count 200 --trials trials.csv\n"
    "  pharos reproduce integrity --kind line --count 400 --tone-curve --markdown\n"
    "  pharos reproduce integrity --kind line --seed 17 --write pictures";

struct Options {
  std::vector<std::string> kinds;
  int count = 4000;
  std::uint64_t seed = 1;
  std::string trials;
  std::string folder;
  bool tone_curve = false;
  bool markdown = false;
  OutputOptions output;
};

bool is_wanted(const Options& options, const IntegrityKind& kind) {
  if (options.tone_curve && !kind.toned) return false;
  return options.kinds.empty() ||
         std::find(options.kinds.begin(), options.kinds.end(), kind.name) != options.kinds.end();
}

int write_pictures(const Options& options) {
  for (const IntegrityKind& kind : integrity_kinds()) {
    const double tone_power = options.tone_curve ? sim::tone_power(options.seed) : 1.0;
    if (is_wanted(options, kind)) kind.write(options.seed, options.folder, tone_power);
  }
  return kExitAnswered;
}

void require_tone_curves(const Options& options) {
  if (!options.tone_curve) return;
  for (const IntegrityKind& kind : integrity_kinds()) {
    const bool is_named = std::find(options.kinds.begin(), options.kinds.end(), kind.name) != options.kinds.end();
    if (is_named && !kind.toned)
      throw host::InputError("--tone-curve draws ring2, line and ellipses, not " + kind.name);
  }
}

int run(const Options& options) {
  require_tone_curves(options);
  if (!options.folder.empty()) return write_pictures(options);
  require_writable(options.output.path);
  std::unique_ptr<Output> trials;
  if (!options.trials.empty()) trials = std::make_unique<Output>(OutputOptions{false, options.trials}, trial_columns());
  std::vector<ComparisonRow> rows;
  for (IntegrityKind kind : integrity_kinds()) {
    if (!is_wanted(options, kind)) continue;
    if (options.tone_curve) kind.trial = kind.toned;
    Progress progress("integrity " + kind.name, "trials", static_cast<std::size_t>(options.count));
    const IntegrityCounts counts =
        run_integrity(kind, options.seed, options.count, trials ? &trials->rows() : nullptr, [&] { progress.step(); });
    for (const ComparisonRow& row : counts.rows(kind)) rows.push_back(row);
  }
  if (trials) trials->finish();
  write_comparison(rows, options.markdown, options.output);
  return kExitAnswered;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const IntegrityKind& kind : integrity_kinds()) names.push_back(kind.name);
  return names;
}

}  // namespace

void add_reproduce_integrity(CLI::App& reproduce, int& exit_code) {
  CLI::App* command =
      reproduce.add_subcommand("integrity", "Thousands of bodies: how many answers are wrong by their own sigmas");
  const auto options = std::make_shared<Options>();
  command->add_option("--kind", options->kinds, "Of these alone; without: all")->check(CLI::IsMember(kind_names()));
  command->add_option("--count", options->count, "Seeds of each kind")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  add_seed_option(*command, options->seed, "The first one");
  command->add_option("--trials", options->trials, "File for one row a quantity of every trial");
  command->add_option("--write", options->folder, "Instead: what is measured of the first seed, into this folder");
  command->add_flag("--tone-curve", options->tone_curve,
                    "By cameras whose grey values are a power of the light: 0.45 to 0.6; ring2, line and ellipses");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
