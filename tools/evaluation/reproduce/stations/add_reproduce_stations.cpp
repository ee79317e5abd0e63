// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/add_reproduce_stations.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "tools/evaluation/reproduce/stations/record_table.hpp"
#include "tools/evaluation/reproduce/stations/station_table.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kStationsExample =
    "DIR holds folders <lh1|lh2>_crossingBeam_<flight|move|jitter> with logNN, mocapNN.csv.gz and\n"
    "system-config.yaml. `published` is what the log's own crossing beams reach. Own geometry: learnt from the first\n"
    "log moved by hand of each generation (pharos calibrate stations), scored with the lever arm estimated.\n"
    "Records: stations as the record's configuration tells.\n\n"
    "Example:\n"
    "  pharos reproduce stations --data ../shared/data/open/crazyflie --markdown";

struct StationTableOptions {
  std::string data, records, residuals;
  bool markdown = false;
  OutputOptions output;
};

int run_station_table(const StationTableOptions& options) {
  require_writable(options.output.path);
  if (!options.residuals.empty()) require_writable(options.residuals);
  std::string data = options.data;
  if (data.empty()) {
    const char* all = std::getenv("PHAROS_DATA");
    data = (std::filesystem::path(all != nullptr ? all : "../shared/data") / "open" / "crazyflie").string();
  }
  const std::string records =
      options.records.empty() ? (std::filesystem::path(data) / ".." / "libsurvive").string() : options.records;
  StationTable table = reproduce_stations(data);
  const std::vector<ComparisonRow> of_records = reproduce_records(records);
  table.rows.insert(table.rows.end(), of_records.begin(), of_records.end());
  write_comparison(table.rows, options.markdown, options.output);
  if (!options.residuals.empty()) write_residual_map(table.residuals, options.residuals);
  return table.rows.empty() ? kExitNoAnswer : kExitAnswered;
}

}  // namespace

void add_reproduce_stations(CLI::App& reproduce, int& exit_code) {
  CLI::App* command = reproduce.add_subcommand("stations", "Two stations beside motion capture, from logs");
  const auto options = std::make_shared<StationTableOptions>();
  command->add_option("--data", options->data, "Folder of the logs (default: PHAROS_DATA/open/crazyflie)");
  command->add_option("--records", options->records,
                      "Folder of libsurvive's records with another tracker's poses (default: libsurvive beside DIR)");
  command->add_flag("--markdown", options->markdown, "A Markdown table, rounded, instead of CSV");
  command
      ->add_option("--residuals", options->residuals,
                   "File for what each plane of the stations leaves, by direction: "
                   "log,geometry,station,plane,azimuth_deg,elevation_deg,sweeps,mean_arcsec,rms_arcsec")
      ->check(output_place());
  add_output_options(*command, options->output);
  command->footer(kStationsExample);
  command->callback([options, &exit_code] { exit_code = run_station_table(*options); });
}

}  // namespace pharos::tools
