// SPDX-License-Identifier: Apache-2.0
#include "host/config/live_changes.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "host/config/load_config.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/stations/network_file.hpp"

namespace pharos::host {
namespace {

bool same_sensors(const Target& a, const Target& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SensorPlacement& x, const SensorPlacement& y) {
    return x.sensor == y.sensor && x.position_m == y.position_m && x.normal == y.normal;
  });
}

bool same_stations(const std::vector<tracking::KnownStation>& a, const std::vector<tracking::KnownStation>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const tracking::KnownStation& x, const tracking::KnownStation& y) {
                      return x.id == y.id && x.slot == y.slot && x.calibration == y.calibration;
                    });
}

bool same_pair(const std::optional<tracking::CalibratedPair>& a, const std::optional<tracking::CalibratedPair>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->reference == b->reference && a->station == b->station &&
         a->T_reference_station.R == b->T_reference_station.R && a->T_reference_station.t == b->T_reference_station.t &&
         a->covariance == b->covariance;
}

// Lines of describe(); an indented line is appended to the line that it belongs to.
std::vector<std::string> settings(const DaemonConfig& config) {
  std::vector<std::string> lines;
  std::istringstream text(describe(config));
  std::string head;
  for (std::string line; std::getline(text, line);) {
    const bool indented = line.rfind("  ", 0) == 0;
    if (!indented) head = line;
    lines.push_back(indented ? head + line.substr(1) : line);
  }
  return lines;
}

// The rate; the estimator keeps its mountings and settings. A mounting file may have changed in what describe() does
// not show.
std::vector<std::string> take_vehicle_changes(const DaemonConfig& fresh, DaemonConfig& config) {
  if (!config.vehicle) return {};
  if (!fresh.vehicle) return {"without [vehicle]"};
  config.vehicle->rate_hz = fresh.vehicle->rate_hz;
  const auto mountings = [](const VehicleConfig& vehicle) {
    Mounting mounting;
    for (const FusedSourceConfig& source : vehicle.sources) mounting.sources.push_back(source.mounting);
    return mounting_text(mounting);
  };
  if (mountings(*config.vehicle) == mountings(*fresh.vehicle)) return {};
  return {"vehicle: " + fresh.vehicle->mounting_file.string() + " has changed"};
}

}  // namespace

bool same_calibration(const TargetConfig& a, const TargetConfig& b) {
  return network_text(a.stations) == network_text(b.stations) && same_sensors(a.target, b.target) &&
         same_stations(a.calibrated_stations, b.calibrated_stations) &&
         same_pair(a.calibrated_pair, b.calibrated_pair) && a.scale_sigma == b.scale_sigma &&
         a.systematic.sensor_position_m == b.systematic.sensor_position_m &&
         a.systematic.rotor_rad == b.systematic.rotor_rad;
}

void take_calibration(const TargetConfig& from, TargetConfig& to) {
  to.calibration_file = from.calibration_file;
  to.target = from.target;
  to.shape = from.shape;
  to.calibrated_stations = from.calibrated_stations;
  to.stations_file = from.stations_file;
  to.stations = from.stations;
  to.calibrated_pair = from.calibrated_pair;
  to.scale_sigma = from.scale_sigma;
  to.systematic = from.systematic;
}

std::vector<std::string> take_live_changes(const DaemonConfig& fresh, DaemonConfig& config) {
  config.log.level = fresh.log.level;
  config.publish = fresh.publish;
  for (TargetConfig& target : config.targets) {
    const auto same = std::find_if(fresh.targets.begin(), fresh.targets.end(),
                                   [&](const TargetConfig& other) { return other.name == target.name; });
    if (same != fresh.targets.end()) take_calibration(*same, target);
  }
  std::vector<std::string> not_taken = take_vehicle_changes(fresh, config);
  const std::vector<std::string> used = settings(config);
  const std::multiset<std::string> known(used.begin(), used.end());
  for (const std::string& line : settings(fresh)) {
    if (!known.contains(line)) not_taken.push_back(line);
  }
  const std::vector<std::string> asked = settings(fresh);
  const std::multiset<std::string> wanted(asked.begin(), asked.end());
  for (const std::string& line : used) {
    const bool heads_a_source = !line.empty() && line.back() == ':';
    if (heads_a_source && !wanted.contains(line)) not_taken.push_back("without " + line);
  }
  return not_taken;
}

}  // namespace pharos::host
