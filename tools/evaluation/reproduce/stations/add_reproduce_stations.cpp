// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/add_reproduce_stations.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "tools/evaluation/reproduce/stations/station_table.hpp"
#include "tools/support/commands.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kStationsExample =
    "DIR holds folders <lh1|lh2>_crossingBeam_<flight|move|jitter> with logNN, mocapNN.csv.gz and\n"
    "system-config.yaml. `published` is what the log's own crossing beams reach. Own geometry: learnt from the first\n"
    "log moved by hand of each generation (pharos calibrate stations), scored with the lever arm estimated.\n\n"
    "Example:\n"
    "  pharos reproduce stations --data ../shared/data/open/crazyflie --markdown";

struct StationTableOptions {
  std::string data;
  bool markdown = false;
  OutputOptions output;
};

int run_station_table(const StationTableOptions& options) {
  require_writable(options.output.path);
  std::string data = options.data;
  if (data.empty()) {
    const char* all = std::getenv("PHAROS_DATA");
    data = (std::filesystem::path(all != nullptr ? all : "../shared/data") / "open" / "crazyflie").string();
  }
  const std::vector<ComparisonRow> rows = reproduce_stations(data);
  write_comparison(rows, options.markdown, options.output);
  return rows.empty() ? kExitNoAnswer : kExitAnswered;
}

}  // namespace

void add_reproduce_stations(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("stations", "Two stations beside motion capture, from logs");
  const auto options = std::make_shared<StationTableOptions>();
  command->add_option("--data", options->data, "Folder of the logs (default: PHAROS_DATA/open/crazyflie)");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  add_output_options(*command, options->output);
  command->footer(kStationsExample);
  command->callback([options, &exit_code] { exit_code = run_station_table(*options); });
}

}  // namespace pharos::tools
