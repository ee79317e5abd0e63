// SPDX-License-Identifier: Apache-2.0
// Instructions from hits to poses in a room of two stations whose places are known; the start and the checks included.
#include "firmware/bench/light.hpp"
#include "pharos/network/network_tracker.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page

network::Stations stations_of(bench::Input& input, std::uint32_t count) {
  network::Stations stations;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto& row = input.next<bench::NetworkStationRow>();
    network::Station station;
    station.number = static_cast<std::uint8_t>(k);
    const auto& [rotation, position_m] = row.T_world_station;
    network::WorldFromStation T_world_station;
    T_world_station.R << rotation[0], rotation[1], rotation[2], rotation[3], rotation[4], rotation[5], rotation[6],
        rotation[7], rotation[8];
    T_world_station.t << position_m[0], position_m[1], position_m[2];
    station.T_world_station = T_world_station;
    station.sigmas = network::StationSigmas{row.sigma_rotation_rad, row.sigma_position_m, row.sigma_plane_rad};
    stations.push_back(station);
  }
  return stations;
}

}  // namespace

int main() {
  bench::Input input;
  const auto& header = input.header<bench::NetworkHeader>();
  static const Target target = bench::target_of(input, header.sensors);
  static const network::Stations stations = stations_of(input, header.stations);
  static network::NetworkTracker tracker(stations, target, network::NetworkOptions{});
  static bench::Counts hits, sweeps;  // of hits: those that gave no result too
  std::uint32_t answered = 0;
  for (std::uint32_t k = 0; k < header.hits; ++k) {
    const auto& row = input.next<bench::HitRow>();
    std::optional<network::NetworkResult> result;
    const std::uint32_t count = bench::instructions_of([&] {
      result = tracker.push(row.station(), row.plane(), {row.time_s, row.sensor(), row.angle_rad});
    });
    hits.add(count);
    if (!result) continue;
    sweeps.add(count);
    if (result->pose.ok()) ++answered;
  }
  bench::say("hit", hits);
  bench::say("sweep", sweeps);
  bench::say("answered", answered);
  bench::say("tracker_bytes", sizeof(network::NetworkTracker));
  return 0;
}
