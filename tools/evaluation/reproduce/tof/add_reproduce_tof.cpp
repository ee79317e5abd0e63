// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/add_reproduce_tof.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/evaluation/reproduce/tof/board_table.hpp"
#include "tools/evaluation/reproduce/tof/four_tests.hpp"
#include "tools/evaluation/reproduce/tof/success_campaign.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Frames are rendered and go through the whole path: ellipses, ring, connector, pose.\n\n"
    "Example:\n"
    "  pharos reproduce tof --markdown\n"
    "  pharos reproduce tof --frames 10\n"
    "  pharos reproduce tof --success 1000";

// No camera comes out of fewer (pharos calibrate camera).
constexpr int kMinBoards = 3;

std::string check_boards(const std::string& text) {
  int boards = 0;
  if (!CLI::detail::lexical_cast(text, boards)) return "must be a whole number";
  if (boards == 0 || (boards >= kMinBoards && boards <= 1000)) return "";
  return "must be 0 (without), or from " + std::to_string(kMinBoards) + " to 1000: a camera needs as many images";
}

struct Options {
  int frames = 100;
  int boards = 20;
  int success = 0;
  std::uint64_t seed = 1;
  std::string threshold = "printed";
  bool markdown = false;
  OutputOptions output;
};

std::vector<ComparisonRow> rows_of(const Options& options) {
  if (options.success > 0) return reproduce_success(options.success, options.seed);
  std::vector<ComparisonRow> rows;
  if (options.boards > 0) rows = reproduce_board_table(options.boards, options.seed);
  for (const ComparisonRow& row :
       reproduce_four_tests({options.frames, options.seed, options.threshold == "printed"}).rows)
    rows.push_back(row);
  return rows;
}

int run(const Options& options) {
  require_writable(options.output.path);
  const std::vector<ComparisonRow> rows = rows_of(options);
  write_comparison(rows, options.markdown, options.output);
  return kExitAnswered;
}

}  // namespace

void add_reproduce_tof(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("tof", "Paper 000: tables 1 to 3; or how many frames have a pose");
  const auto options = std::make_shared<Options>();
  command->add_option("--frames", options->frames, "Of each of the four tests")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  command->add_option("--boards", options->boards, "Images of each calibration board of table 1; 0: without")
      ->check(check_boards)
      ->capture_default_str();
  command
      ->add_option("--success", options->success,
                   "Instead: this many random poses of either ring, a third of it hidden")
      ->check(CLI::Range(1, 1'000'000));
  command
      ->add_option("--threshold", options->threshold,
                   "(5) of the paper's chain: printed (over the mean grey value), or count (of pixels)")
      ->check(CLI::IsMember({"printed", "count"}))
      ->capture_default_str();
  add_seed_option(*command, options->seed, "Of foil, poses and noise");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
