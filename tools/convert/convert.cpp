// SPDX-License-Identifier: Apache-2.0
// pharos convert: logs that other projects' programs wrote, to the tables of pharos.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>

#include "host/support/input_error.hpp"
#include "host/table/byte_source.hpp"
#include "tools/convert/converted_folder.hpp"
#include "tools/convert/crazyflie_log.hpp"
#include "tools/convert/crazyflie_sweeps.hpp"
#include "tools/convert/libsurvive_config.hpp"
#include "tools/convert/libsurvive_record.hpp"
#include "tools/convert/system_config.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/standard_input.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos convert crazyflie log01 --config system-config.yaml --output flight\n"
    "  pharos convert libsurvive room.rec.gz --output room\n"
    "  pharos track --sweeps flight/sweeps.csv --stations flight/stations.toml --target flight/target.csv > poses.csv\n"
    "Written: sweeps.csv (the columns of `pharos decode` and generation; LH1: axis x or y and theta as there; LH2: "
    "axis a\n"
    "or b, the first or second plane, theta 0 straight ahead), stations.toml, target.csv and, where the log has them,\n"
    "imu.csv, crossing_beam.csv, events.csv, external_pose.csv. Times in seconds of the log's own clock.";

constexpr std::size_t kLargestLog = std::size_t{1} << 30U;

std::string read_whole(const std::string& path) {
  host::ByteSource source(path);
  std::string bytes;
  std::array<char, 65536> part{};
  while (const std::size_t count = source.read(part)) {
    bytes.append(part.data(), count);
    if (bytes.size() > kLargestLog) throw host::InputError(source.name() + ": larger than a gibibyte: not such a log");
  }
  return bytes;
}

std::string named(const std::string& path) { return path == "-" ? "standard input" : path; }

int crazyflie(const std::string& path, const std::string& config, const std::string& output) {
  require_one_standard_input({{"LOG", path}, {"--config", config}});
  const std::string bytes = read_whole(path);
  convert::CrazyflieLog log = convert::read_crazyflie_log(
      std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), named(path));
  convert::ConvertedLog out;
  out.stations = convert::read_system_config(read_whole(config), named(config));
  out.generation = static_cast<int>(out.stations[0].generation);
  convert::CrazyflieSweeps sweeps = convert::sweeps_of(log, out.generation);
  out.hits = std::move(sweeps.hits);
  out.target = convert::lighthouse_deck();
  out.imu = std::move(log.imu);
  out.crossing_beams = std::move(log.crossing_beams);
  out.events = std::move(log.events);
  convert::write_folder(output, out);
  note(named(path) + ": " + std::to_string(out.hits.size()) + " hits, " + std::to_string(sweeps.repeated) +
       " logged again, " + std::to_string(sweeps.untimed) + " of an unknown time, " + std::to_string(log.unusable) +
       " unusable; its clock runs at " + std::to_string(sweeps.clock_rate) + " of the rotors'");
  return out.hits.empty() ? kExitNoAnswer : kExitAnswered;
}

// The device asked for, or the one with most hits.
const convert::RecordedDevice& device_of(const convert::LibsurviveRecord& record, const std::string& wanted,
                                         const std::string& path) {
  std::string names;
  const convert::RecordedDevice* best = nullptr;
  for (const auto& [name, device] : record.devices) {
    if (name == wanted) return device;
    names += (names.empty() ? "" : ", ") + name + " (" + std::to_string(device.hits.size()) + " hits)";
    if (best == nullptr || device.hits.size() > best->hits.size()) best = &device;
  }
  if (!wanted.empty()) throw host::InputError(path + ": no device " + wanted + "; it has " + names);
  if (best == nullptr) throw host::InputError(path + ": no device with light");
  if (record.devices.size() > 1) note(path + ": several devices: " + names + "; taken: " + best->name + " (--device)");
  return *best;
}

// Every channel that was heard has a station, told or not.
network::Stations stations_of(const std::string& config, const convert::RecordedDevice& device) {
  network::Stations stations;
  if (!config.empty()) stations = convert::read_libsurvive_config(read_whole(config), named(config));
  for (const convert::LightHit& hit : device.hits) {
    if (network::find_station(stations, hit.station) != nullptr) continue;
    network::Station station;
    station.number = hit.station;
    station.generation = network::Generation::kLighthouse2;
    stations.push_back(station);
  }
  return stations;
}

int libsurvive(const std::string& path, std::string config, const std::string& wanted, const std::string& output) {
  if (config.empty() && std::filesystem::exists(path + ".json")) config = path + ".json";
  require_one_standard_input({{"REC", path}, {"--config", config}});
  const convert::LibsurviveRecord record = convert::read_libsurvive_record(host::ByteSource(path));
  const convert::RecordedDevice& device = device_of(record, wanted, named(path));
  convert::ConvertedLog out;
  out.generation = 2;
  out.stations = stations_of(config, device);
  convert::place_stations(record, out.stations);
  out.hits = device.hits;
  out.target = device.target;
  out.imu = device.imu;
  for (const convert::ExternalPose& pose : record.external) {
    if (pose.device == device.name || pose.device == "replay_" + device.name) out.external.push_back(pose);
  }
  convert::write_folder(output, out);
  if (record.cut_off) note(named(path) + ": cut off: what came before was used");
  if (config.empty())
    note(named(path) + ": no configuration beside it: stations.toml has neither calibration nor pose");
  note(named(path) + ": " + device.name + ": " + std::to_string(out.hits.size()) + " hits, " +
       std::to_string(device.without_sync) + " without a sync");
  return out.hits.empty() ? kExitNoAnswer : kExitAnswered;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("convert", "Logs of Crazyflie and libsurvive to tables of pharos");
  command->require_subcommand(1);
  command->footer(kExample);
  struct Options {
    std::string log, config, device, output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* cf = command->add_subcommand("crazyflie", "A log of a Crazyflie's memory card");
  cf->add_option("LOG", options->log, "The log; .gz; - is standard input")->required();
  cf->add_option("--config", options->config, "system-config.yaml: the stations' calibration and geometry")->required();
  cf->add_option("-o,--output", options->output, "Folder to write")->required();
  cf->footer(kExample);
  cf->callback([options, &exit_code] { exit_code = crazyflie(options->log, options->config, options->output); });
  CLI::App* ls = command->add_subcommand("libsurvive", "A record of libsurvive");
  ls->add_option("REC", options->log, "The record; .gz; - is standard input")->required();
  ls->add_option("--config", options->config, "libsurvive's configuration; default: REC.json where it is there");
  ls->add_option("--device", options->device, "Which device's light; default: the one with most hits");
  ls->add_option("-o,--output", options->output, "Folder to write")->required();
  ls->footer(kExample);
  ls->callback([options, &exit_code] {
    exit_code = libsurvive(options->log, options->config, options->device, options->output);
  });
}

}  // namespace pharos::tools
