// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_start.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pose/solve.hpp"

namespace pharos::network {
namespace {

// Sweeps of a station's two planes that make one picture of the body.
constexpr double kPair_s = 0.03;
constexpr double kTriangulated_s = 0.07, kTriangulated_m = 1e-3, kLargestStep_m = 0.5, kWorstAngle_rad = 0.015;
constexpr int kTriangulationSteps = 30;

const PlaneSweep* last_of(const RecentSweeps& recent, std::size_t station, std::size_t plane) {
  for (std::size_t i = recent.size(); i-- > 0;) {
    if (recent[i].station == station && recent[i].plane == plane) return &recent[i];
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

Starts starts_of(const RecentSweeps& recent, const Stations& stations, const Target& target) {
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

std::optional<Vector3> triangulate(const RecentSweeps& recent, const Stations& stations, const Target& target,
                                   const WorldFromBody& near) {
  if (recent.empty()) return std::nullopt;
  const double now_s = recent[recent.size() - 1].time_s();
  StaticVector<const PlaneSweep*, kPlanes * kMaxNetworkStations> sweeps;
  int seen = 0;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const PlaneSweep* a = last_of(recent, s, 0);
    const PlaneSweep* b = last_of(recent, s, 1);
    if (a == nullptr || b == nullptr || std::min(a->time_s(), b->time_s()) < now_s - kTriangulated_s) continue;
    sweeps.push_back(a);
    sweeps.push_back(b);
    ++seen;
  }
  if (seen < 2) return std::nullopt;
  Vector3 t = near.t;
  for (int step = 0; step < kTriangulationSteps; ++step) {
    Matrix3 A = Matrix3::Identity() * 1e-6;
    Vector3 b = Vector3::Zero();
    double worst = 0.0;
    for (const PlaneSweep* sweep : sweeps) {
      const Station& station = stations[sweep->station];
      const WorldFromStation& T = *station.T_world_station;
      Vector3 gradient = Vector3::Zero();
      double residual = 0.0;
      int count = 0;
      for (const Hit& hit : sweep->hits) {
        const SensorPlacement* sensor = find_sensor(target, hit.sensor);
        if (sensor == nullptr) continue;
        const Vector3 p = T.R.transpose() * (t + near.R * sensor->position_m - T.t);
        if (!(p.z() > 0.05)) return std::nullopt;
        residual += hit.angle_rad - raw_angle(station, sweep->plane, p);
        gradient += T.R * ideal_gradient(station.generation, sweep->plane, p);
        ++count;
      }
      if (count == 0) continue;
      residual /= count;
      gradient /= count;
      worst = std::max(worst, std::abs(residual));
      A += gradient * gradient.transpose();
      b += gradient * residual;
    }
    const Vector3 d = A.inverse() * b;
    if (!d.allFinite()) return std::nullopt;
    t += d * std::min(1.0, kLargestStep_m / std::max(1e-12, d.norm()));
    if (d.norm() < kTriangulated_m) return worst < kWorstAngle_rad ? std::optional(t) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace pharos::network
