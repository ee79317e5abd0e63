// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pharos/network/network_tracker.hpp"
#include "tools/evaluation/bench/comparison_table.hpp"

namespace pharos::tools {

/// A hit of one of several stations.
struct NetworkBenchHit {
  std::uint8_t station = 0;
  std::size_t plane = 0;
  network::Hit hit;
};

/// Light of a simulated flight: the paper's manoeuvre of its target before two stations of known poses 2 m apart.
struct NetworkFlight {
  network::Stations stations;
  Target target;
  std::vector<NetworkBenchHit> hits;
};
NetworkFlight network_flight(double duration_s);

/// A run through all hits of a flight.
struct NetworkRun {
  double cost_us = 0.0;  // a hit
  int answered = 0;      // sweeps
};
NetworkRun run_network(const NetworkFlight& flight);

/// Cost of `pharos track --sweeps` with two stations, microseconds a hit on one core, everything included.
std::vector<BenchRow> bench_network();

}  // namespace pharos::tools
