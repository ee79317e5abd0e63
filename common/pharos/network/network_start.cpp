// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_start.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pose/solve.hpp"

namespace pharos::network {
namespace {

// Sweeps of a station's two planes that make one picture of the body.
constexpr double kPair_s = 0.03;

const PlaneSweep* last_of(const SweepView& recent, std::size_t station, std::size_t plane) {
  for (std::size_t i = recent.size(); i-- > 0;) {
    if (recent[i]->station == station && recent[i]->plane == plane) return recent[i];
  }
  return nullptr;
}

pose::Observations bearings_of(const PlaneSweep& a, const PlaneSweep& b, const Station& station, const Target& target) {
  pose::Observations out;
  for (const Hit& one : a.hits) {
    if (find_sensor(target, one.sensor) == nullptr) continue;
    for (const Hit& other : b.hits) {
      if (other.sensor != one.sensor) continue;
      const auto direction = direction_of(station, {one.angle_rad, other.angle_rad});
      if (!direction) continue;
      const lighthouse::ThetaPair theta = lighthouse::ideal_thetas(*direction);
      out.push_back({one.sensor, Axis::kX, theta.x_rad});
      out.push_back({one.sensor, Axis::kY, theta.y_rad});
      break;
    }
  }
  return out;
}

WorldFromBody in_world(const WorldFromStation& station, const LighthouseFromBody& pose) { return station * pose; }

}  // namespace

Starts starts_of(const SweepView& recent, const Stations& stations, const Target& target) {
  Starts starts;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const PlaneSweep* a = last_of(recent, s, 0);
    const PlaneSweep* b = last_of(recent, s, 1);
    if (a == nullptr || b == nullptr || std::abs(a->time_s() - b->time_s()) > kPair_s) continue;
    const pose::Observations bearings = bearings_of(*a, *b, stations[s], target);
    const auto solution = pose::solve(target, bearings, {});
    if (!solution) continue;
    const LighthousePoseEstimate& estimate = solution.value().estimate;
    starts.push_back(in_world(*stations[s].T_world_station, estimate.pose));
    if (estimate.second) starts.push_back(in_world(*stations[s].T_world_station, estimate.second->pose));
  }
  return starts;
}

}  // namespace pharos::network
