// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_network.hpp"

#include <algorithm>
#include <memory>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/bearing.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kNetworkRepeats = 9;
constexpr double kNetworkFlight_s = 20.0;

sim::LighthouseScenario two_stations(double duration_s) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = duration_s;
  scenario.target = test::frustum_target();
  scenario.stations.resize(2);
  scenario.stations[0].mode = sim::StationMode::kB;
  scenario.stations[1].mode = sim::StationMode::kC;
  scenario.stations[1].id = 0xC33B4DE1U;
  scenario.stations[1].pose.t = {2.0, 0.0, 0.0};
  scenario.stations[1].pose.R = rotation_exp(Vector3(0.0, -0.5, 0.0));
  scenario.trajectory = sim::make_random_manoeuvre({}, duration_s, sim::RandomStream(1, "bench motion"));
  return scenario;
}

}  // namespace

NetworkFlight network_flight(double duration_s) {
  const sim::LighthouseScenario scenario = two_stations(duration_s);
  NetworkFlight flight;
  flight.target = scenario.target;
  for (std::size_t k = 0; k < scenario.stations.size(); ++k) {
    network::Station station;
    station.number = static_cast<std::uint8_t>(k);
    station.T_world_station = network::WorldFromStation{scenario.stations[k].pose.R, scenario.stations[k].pose.t};
    station.sigmas = network::StationSigmas{1e-3, 1e-3, 3e-4};
    flight.stations.push_back(station);
  }
  sim::LighthouseSimulator simulator(scenario, 1);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  while (const auto pulse = simulator.next()) {
    decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    while (decoder->take_ootx()) {
    }
    while (const auto sweep = decoder->take_sweep()) {
      for (const lighthouse::Bearing& bearing : lighthouse::bearings_of(*sweep)) {
        flight.hits.push_back({sweep->flash.station,
                               static_cast<std::size_t>(index_of(sweep->flash.axis)),
                               {ticks_to_seconds(bearing.time_ticks), bearing.sensor, bearing.theta_rad}});
      }
    }
  }
  std::stable_sort(flight.hits.begin(), flight.hits.end(),
                   [](const auto& a, const auto& b) { return a.hit.time_s < b.hit.time_s; });
  return flight;
}

NetworkRun run_network(const NetworkFlight& flight) {
  const auto tracker =
      std::make_unique<network::NetworkTracker>(flight.stations, flight.target, network::NetworkOptions{});
  NetworkRun run;
  const double spent_s = seconds_of([&] {
    for (const NetworkBenchHit& one : flight.hits) {
      const auto result = tracker->push(one.station, one.plane, one.hit);
      if (result && result->pose.ok()) ++run.answered;
    }
  });
  constexpr double kMicroseconds = 1e6;
  run.cost_us = spent_s * kMicroseconds / static_cast<double>(flight.hits.size());
  return run;
}

std::vector<BenchRow> bench_network() {
  const NetworkFlight flight = network_flight(kNetworkFlight_s);
  double best_us = 1e9;
  for (int k = 0; k < kNetworkRepeats; ++k) best_us = std::min(best_us, run_network(flight).cost_us);
  return {{"stations of a room, a hit, two stations in one model", best_us, std::nullopt, "us", true}};
}

}  // namespace pharos::tools
