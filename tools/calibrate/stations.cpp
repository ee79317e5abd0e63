// SPDX-License-Identifier: Apache-2.0
// pharos calibrate stations: a recording of a target that is carried around to the stations' poses and calibration.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "host/calibrate/stations/station_calibration.hpp"
#include "host/stations/network_file.hpp"
#include "host/stations/sweep_table.hpp"
#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/calibrate/add_calibrate.hpp"
#include "tools/calibrate/station_reports.hpp"
#include "tools/calibrate/text_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kStationsExample =
    "Example:\n"
    "  pharos convert crazyflie log02 --config system-config.yaml --output carried\n"
    "  pharos calibrate stations carried/sweeps.csv --target carried/target.csv --stations carried/stations.toml \\\n"
    "    --up carried/imu.csv --output stations.toml\n"
    "  pharos track --sweeps flight/sweeps.csv --stations stations.toml --target flight/target.csv > poses.csv\n"
    "Carry the target for a minute or two where two stations see it: near and far, to all sides, tilted. No length is\n"
    "measured: the scale is that of the target's own size. On standard output: parameter,prior,value,prior_sigma,\n"
    "sigma,told (told: share of the variance that the recording took away); residuals and scale on standard error.";

// Of an hour under two stations; more is no better.
constexpr std::size_t kMaxHits = 4'000'000;

struct StationOptions {
  std::string sweeps, target, stations, up, output;
  double sensor_sigma_mm = 0.2;
  bool json = false;
};

// Rows of the sweeps' table; `stations` grows by those heard where no file tells them.
calibrate::NetworkLog read_log(const std::string& path, bool told, network::Stations& stations) {
  host::SweepTable table(path);
  calibrate::NetworkLog log;
  log.name = table.name();
  while (table.next()) {
    const std::uint8_t number = table.station();
    const network::Station* known = network::find_station(stations, number);
    if (known == nullptr) {
      if (told) continue;
      if (stations.full()) throw host::InputError(log.name + ": more than 16 stations; give --stations");
      network::Station heard;
      heard.number = number;
      heard.generation = table.generation();
      stations.push_back(heard);
      known = &stations[stations.size() - 1];
    }
    table.require(known->generation);
    if (log.hits.size() == kMaxHits)
      throw host::InputError(log.name + ": more than 4 million hits; give an hour of it");
    log.hits.push_back({number, table.plane(), table.hit()});
  }
  std::stable_sort(log.hits.begin(), log.hits.end(),
                   [](const auto& a, const auto& b) { return a.hit.time_s < b.hit.time_s; });
  return log;
}

std::vector<calibrate::Acceleration> read_accelerations(const std::string& path) {
  host::TableReader table(host::ByteSource(path), {"time_s", "acc_x_m_s2", "acc_y_m_s2", "acc_z_m_s2"});
  std::vector<calibrate::Acceleration> out;
  while (table.next()) out.push_back({table.number(0), {table.number(1), table.number(2), table.number(3)}});
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  if (out.empty()) throw host::InputError(table.name() + ": no accelerations");
  return out;
}

void note_unheard(const network::Stations& told, const network::Stations& used, const std::string& path) {
  for (const network::Station& station : told) {
    if (network::find_station(used, station.number) != nullptr) continue;
    note(path + ": station " + std::to_string(station.number) + " was hardly heard: not in the output");
  }
}

int run_stations(const StationOptions& options) {
  require_one_standard_input({{"SWEEPS", options.sweeps},
                              {"--target", options.target},
                              {"--stations", options.stations},
                              {"--up", options.up}});
  require_writable(options.output);
  calibrate::StationCalibrationInput input;
  const host::TargetFile target = host::read_target(options.target);
  input.target = target.target;
  input.sensor_sigma_m = options.sensor_sigma_mm / kMmPerM;
  const bool told = !options.stations.empty();
  if (told) input.stations = host::read_network_file(options.stations);
  input.log = read_log(options.sweeps, told, input.stations);
  if (!options.up.empty()) input.accelerations = read_accelerations(options.up);
  const calibrate::StationCalibration calibration = calibrate::calibrate_stations(input);
  write_text_file(options.output, stations_text(calibration));
  if (options.output != "-") write_station_parameters(calibration, {options.json, "-"});
  note_target_shape(options.target, target.shape);
  note_unheard(input.stations, calibration.stations, told ? options.stations : options.sweeps);
  note_stations(calibration);
  return kExitAnswered;
}

}  // namespace

void add_calibrate_stations(CLI::App& calibrate, int& exit_code) {
  CLI::App* command = calibrate.add_subcommand(
      "stations", "Poses and calibration of a room's base stations from a target that is carried around");
  const auto options = std::make_shared<StationOptions>();
  command->add_option("SWEEPS", options->sweeps, "Table of hits, as `pharos convert` writes it; .gz")->required();
  command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]")->required();
  command->add_option("--stations", options->stations,
                      "The stations' own calibration and, where known, poses (TOML), to start from; default: none");
  command->add_option("--up", options->up, "Table of accelerations (imu.csv): the world's z is turned up");
  command->add_option("-o,--output", options->output, "File of stations to write (TOML); - is standard output")
      ->check(output_place())
      ->required();
  command
      ->add_option("--sensor-sigma-mm", options->sensor_sigma_mm,
                   "How well the target was built: 1 sigma of each coordinate")
      ->check(number_from(1e-3, 100.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "The table as one JSON object a line instead of CSV");
  command->footer(kStationsExample);
  command->callback([options, &exit_code] { exit_code = run_stations(*options); });
}

}  // namespace pharos::tools
