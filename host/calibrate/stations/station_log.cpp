// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_log.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::calibrate {
namespace {

constexpr double kSweep_s = 0.004;       // a plane passes a target within this time
constexpr std::size_t kOverlapping = 4;  // sweeps of several stations that may pass it at once

}  // namespace

std::vector<network::PlaneSweep> plane_sweeps(const NetworkLog& log, const network::Stations& stations) {
  std::vector<network::PlaneSweep> out;
  for (const NetworkHit& one : log.hits) {
    const network::Station* station = network::find_station(stations, one.station);
    if (station == nullptr) continue;
    const auto place = static_cast<std::size_t>(station - stations.begin());
    network::PlaneSweep* open = nullptr;
    for (std::size_t back = 1; back <= std::min(kOverlapping, out.size()); ++back) {
      network::PlaneSweep& sweep = out[out.size() - back];
      const bool same = sweep.station == place && sweep.plane == one.plane && !sweep.hits.full() &&
                        std::abs(one.hit.time_s - sweep.hits[0].time_s) < kSweep_s;
      if (same) open = &sweep;
    }
    if (open == nullptr) {
      out.emplace_back();
      open = &out.back();
      open->station = place;
      open->plane = one.plane;
    }
    open->hits.push_back(one.hit);
  }
  return out;
}

}  // namespace pharos::calibrate
