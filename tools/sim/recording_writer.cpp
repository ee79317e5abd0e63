// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/recording_writer.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "host/files/atomic_file.hpp"
#include "host/stations/station_file.hpp"
#include "host/support/input_error.hpp"
#include "host/table/row_writer.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/recording_tables.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;
using host::InputError;

std::int64_t stamp(std::int64_t ticks, bool wrap32) { return wrap32 ? ticks & 0xFFFFFFFF : ticks; }

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void write_truth(const fs::path& path, const LighthouseSimulator& simulator) {
  host::AtomicFile file(path.string());
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv,
                       {"time_s", "station", "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"});
  const auto first = static_cast<std::int64_t>(std::ceil(simulator.start_s() * 1000.0));
  const auto last = static_cast<std::int64_t>(std::floor(simulator.end_s() * 1000.0));
  for (std::int64_t millisecond = first; millisecond <= last; ++millisecond) {
    const double time_s = static_cast<double>(millisecond) / 1000.0;
    for (std::size_t station = 0; station < simulator.stations().size(); ++station) {
      const LighthouseFromBody T = simulator.truth(station, time_s);
      const Quaternion q = T.quaternion();
      rows.number(time_s).integer(static_cast<std::int64_t>(station));
      rows.number(q.w()).number(q.x()).number(q.y()).number(q.z());
      rows.number(T.t.x()).number(T.t.y()).number(T.t.z());
      rows.end_row();
    }
  }
  rows.flush();
  file.commit();
}

lighthouse::StationCalibration calibration(std::uint32_t id, const std::array<SheetErrors, 2>& errors) {
  lighthouse::StationCalibration station;
  station.id = id;
  for (std::size_t rotor = 0; rotor < errors.size(); ++rotor) {
    const SheetErrors& e = errors[rotor];
    station.rotor[rotor] = {e.phase_rad, e.tilt_rad, e.curve_rad, e.gibbous_phase_rad, e.gibbous_magnitude_rad};
  }
  return station;
}

// The calibrations that the stations announce.
void write_announced(const fs::path& path, const LighthouseSimulator& simulator) {
  std::string text = "# What the simulated stations say of themselves, for track --calibration.\n";
  for (const SimulatedStation& station : simulator.stations()) {
    text += "\n" + host::station_text(calibration(station.announced.id, station.announced.rotor));
  }
  host::write_file(path.string(), text);
}

// Their true calibrations, also for track --calibration. Their poses are written as comments.
void write_true(const fs::path& path, const LighthouseSimulator& simulator) {
  std::string text = "# The simulated stations as they are, for track --calibration FILE --form " +
                     std::to_string(static_cast<int>(simulator.scenario().form)) + ".\n";
  for (const SimulatedStation& station : simulator.stations()) {
    const Quaternion q = station.pose.quaternion();
    const Vector3& t = station.pose.t;
    text += std::string("\n# mode ") + "ABC"[station.announced.mode] + "; in the room: position_m " + shortest(t.x()) +
            ", " + shortest(t.y()) + ", " + shortest(t.z()) + "; orientation_wxyz " + shortest(q.w()) + ", " +
            shortest(q.x()) + ", " + shortest(q.y()) + ", " + shortest(q.z()) + "\n";
    text += host::station_text(calibration(station.announced.id, station.true_errors));
  }
  host::write_file(path.string(), text);
}

}  // namespace

RecordingSummary write_recording(const LighthouseScenario& scenario, std::uint64_t seed, const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw InputError(directory.string() + ": cannot be made: " + error.message() + "; choose another --output");
  LighthouseSimulator simulator(scenario, seed);
  RecordingSummary summary;
  GzipTable pulses(directory / "edges.csv.gz", "sensor,rise_ticks,fall_ticks");
  const bool wrap32 = scenario.clock.wrap32;
  while (const std::optional<SimulatedPulse> pulse = simulator.next()) {
    pulses.row({pulse->sensor, stamp(pulse->rise_ticks, wrap32), stamp(pulse->fall_ticks, wrap32)});
    ++summary.pulses;
  }
  pulses.close();
  write_truth(directory / "truth.csv", simulator);
  write_target(directory / "target.csv", simulator.nominal_target());
  write_target(directory / "target_true.csv", simulator.true_target());
  write_announced(directory / "stations.toml", simulator);
  write_true(directory / "stations_true.toml", simulator);
  write_faults(directory / "faults.csv", simulator.faults());
  summary.duration_s = simulator.end_s() - simulator.start_s();
  summary.faults = simulator.faults().size();
  return summary;
}

}  // namespace pharos::sim
