// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/lh2_recording.hpp"

#include <cmath>
#include <string>

#include "host/stations/network_file.hpp"
#include "host/support/input_error.hpp"
#include "host/table/row_writer.hpp"
#include "tools/sim/lh2/lh2_simulator.hpp"
#include "tools/sim/recording_tables.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

void write_room_truth(const fs::path& path, const Lh2Simulator& simulator) {
  host::AtomicFile file(path.string());
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv,
                       {"time_s", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"});
  const auto first = static_cast<std::int64_t>(std::ceil(simulator.start_s() * 1000.0));
  const auto last = static_cast<std::int64_t>(std::floor(simulator.end_s() * 1000.0));
  for (std::int64_t millisecond = first; millisecond <= last; ++millisecond) {
    const double time_s = static_cast<double>(millisecond) / 1000.0;
    const RoomFromBody T = simulator.truth(time_s);
    const Quaternion q = T.quaternion();
    rows.number(time_s).number(q.w()).number(q.x()).number(q.y()).number(q.z());
    rows.number(T.t.x()).number(T.t.y()).number(T.t.z());
    rows.end_row();
  }
  rows.flush();
  file.commit();
}

// Each pass of a laser plane over a sensor, in the order in which they were simulated.
void write_passes(const fs::path& path, const Lh2Simulator& simulator) {
  host::AtomicFile file(path.string());
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv,
                       {"time_s", "station", "axis", "sensor", "turned_rad", "sync_s", "slow_bit", "reflection"});
  for (const LightPass& pass : simulator.passes()) {
    rows.number(pass.time_s).integer(simulator.stations()[static_cast<std::size_t>(pass.station)].channel);
    rows.text(pass.plane == 0 ? "a" : "b").integer(pass.sensor).number(pass.turned_rad).number(pass.sync_s);
    rows.integer(pass.slow_bit ? 1 : 0).integer(pass.reflection ? 1 : 0).end_row();
  }
  rows.flush();
  file.commit();
}

void write_stations(const fs::path& path, const Lh2Simulator& simulator, bool actual) {
  network::Stations stations;
  for (const Lh2SimStation& simulated : simulator.stations()) {
    network::Station station;
    station.number = static_cast<std::uint8_t>(simulated.channel);
    station.id = simulated.id;
    station.generation = network::Generation::kLighthouse2;
    // What the announced values are wrong by; poses are exact.
    const ErrorScenario& errors = simulator.scenario().errors;
    station.sigmas =
        network::StationSigmas{1e-4, 1e-4, actual ? 2e-5 : std::hypot(2e-5, errors.phase_rad, errors.tilt_rad)};
    station.T_world_station = network::WorldFromStation{simulated.pose.R, simulated.pose.t};
    for (std::size_t k = 0; k < 2; ++k) {
      const PlaneErrors& e = actual ? simulated.actual[k] : simulated.announced[k];
      station.plane[k] = {e.phase_rad,      e.tilt_rad,      e.curve, e.gibbous_phase_rad, e.gibbous_magnitude_rad,
                          e.ogee_phase_rad, e.ogee_magnitude};
    }
    stations.push_back(station);
  }
  host::write_file(path.string(), host::network_text(stations));
}

}  // namespace

Lh2RecordingSummary write_lh2_recording(const LighthouseScenario& scenario, std::uint64_t seed,
                                        const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw host::InputError(directory.string() + ": cannot be made: " + error.message() + "; choose another --output");
  }
  Lh2Simulator simulator(scenario, seed);
  Lh2RecordingSummary summary;
  GzipTable light(directory / "light.csv.gz", "sensor,time_ticks,data,envelope");
  while (const auto change = simulator.next()) {
    const std::int64_t ticks = scenario.clock.wrap32 ? change->time_ticks & 0xFFFFFFFF : change->time_ticks;
    light.row({change->sensor, ticks, change->data ? 1 : 0, change->envelope ? 1 : 0});
    ++summary.changes;
  }
  light.close();
  write_passes(directory / "passes.csv", simulator);
  write_room_truth(directory / "truth.csv", simulator);
  write_target(directory / "target.csv", simulator.nominal_target());
  write_target(directory / "target_true.csv", simulator.true_target());
  write_stations(directory / "stations.toml", simulator, false);
  write_stations(directory / "stations_true.toml", simulator, true);
  write_faults(directory / "faults.csv", simulator.faults());
  summary.duration_s = simulator.end_s() - simulator.start_s();
  summary.passes = simulator.passes().size();
  summary.faults = simulator.faults().size();
  return summary;
}

}  // namespace pharos::sim
