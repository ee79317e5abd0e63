// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/station_consensus.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/geometry/symmetric.hpp"

namespace pharos::network {
namespace {

constexpr std::size_t kMinStations = 3;
constexpr double kDisagree = 4.0, kAgree = 2.5, kRatio = 2.5;  // in sigmas; of one RMS to the other
constexpr int kSteps = 12;
constexpr double kNearest_m = 0.05, kLargestStep_m = 0.5, kConverged_m = 1e-4;
// What acceleration and a wrong attitude of a small target do within the recent sweeps.
constexpr double kMotion_rad = 0.5e-3;
// A body's velocity is not above this, 1 sigma: where sweeps do not tell it.
constexpr double kVelocity_m_s = 3.0;

struct MeanAngle {
  double residual_rad = 0.0;
  Vector3 gradient = Vector3::Zero();
  double sigma_rad = 1.0;
};

std::optional<MeanAngle> mean_angle(const PlaneSweep& sweep, const Station& station, const Target& target,
                                    const WorldFromBody& body, const StationSigmas& unstated) {
  const WorldFromStation& T = *station.T_world_station;
  MeanAngle out;
  int count = 0;
  double range_m = 0.0;
  for (const Hit& hit : sweep.hits) {
    const SensorPlacement* sensor = find_sensor(target, hit.sensor);
    if (sensor == nullptr) continue;
    const Vector3 p = T.R.transpose() * (body * sensor->position_m - T.t);
    if (!(p.z() > kNearest_m)) return std::nullopt;
    out.residual_rad += hit.angle_rad - raw_angle(station, sweep.plane, p);
    out.gradient += T.R * ideal_gradient(station.generation, sweep.plane, p);
    range_m = p.norm();
    ++count;
  }
  if (count == 0) return std::nullopt;
  out.residual_rad /= count;
  out.gradient /= count;
  out.sigma_rad = std::hypot(station.sigmas.value_or(unstated).contradiction_rad(range_m, body.t), kMotion_rad);
  return out;
}

// RMS of what the sweeps of all stations but `without` leave, in sigmas. Empty where there is no solution.
std::optional<double> left_without(std::size_t without, const SweepView& recent, const Stations& stations,
                                   const Target& target, const WorldFromBody& near, const StationSigmas& unstated) {
  const double now_s = recent.back()->time_s();
  Vector3 t = near.t, v = Vector3::Zero();
  for (int step = 0; step < kSteps; ++step) {
    Matrix6 A = Matrix6::Zero();
    A.diagonal().head<3>().setConstant(1e-6);
    A.diagonal().tail<3>().setConstant(1.0 / (kVelocity_m_s * kVelocity_m_s));
    Vector6 b = Vector6::Zero();
    b.tail<3>() = -v / (kVelocity_m_s * kVelocity_m_s);
    double square = 0.0;
    int count = 0;
    for (const PlaneSweep* sweep : recent) {
      if (sweep->station == without) continue;
      const double dt_s = sweep->time_s() - now_s;
      const auto angle = mean_angle(*sweep, stations[sweep->station], target, {near.R, t + dt_s * v}, unstated);
      if (!angle || !std::isfinite(angle->residual_rad)) continue;
      Vector6 h;
      h << angle->gradient, dt_s * angle->gradient;
      const double weight = 1.0 / (angle->sigma_rad * angle->sigma_rad);
      A += weight * h * h.transpose();
      b += weight * angle->residual_rad * h;
      square += weight * angle->residual_rad * angle->residual_rad;
      ++count;
    }
    if (count < 4) return std::nullopt;
    const Vector6 d = solve_symmetric<6>(A, b);
    if (!d.allFinite()) return std::nullopt;
    const double part = std::min(1.0, kLargestStep_m / std::max(1e-12, d.head<3>().norm()));
    t += part * d.head<3>();
    v += part * d.tail<3>();
    if (d.head<3>().norm() < kConverged_m) return std::sqrt(square / count);
  }
  return std::nullopt;
}

}  // namespace

Consensus consensus_of(const SweepView& recent, const Stations& stations, const Target& target,
                       const WorldFromBody& near, const StationSigmas& unstated) {
  std::array<int, kMaxNetworkStations> sweeps{};
  for (const PlaneSweep* sweep : recent) ++sweeps[sweep->station];
  const auto heard = std::count_if(sweeps.begin(), sweeps.end(), [](int count) { return count > 1; });
  if (heard < static_cast<std::ptrdiff_t>(kMinStations)) return {};
  const auto without = [&](std::size_t s) { return left_without(s, recent, stations, target, near, unstated); };
  const auto all = without(kMaxNetworkStations);
  if (all && *all < kDisagree) return {};
  std::size_t best = 0;
  double least = 1e9, second = 1e9;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    if (sweeps[s] < 2) continue;
    const double left = without(s).value_or(1e8);
    if (left < least) {
      second = least;
      least = left;
      best = s;
    } else {
      second = std::min(second, left);
    }
  }
  const bool clear = least < kAgree && second > kDisagree && second > kRatio * least;
  return {true, clear ? std::optional(best) : std::nullopt};
}

}  // namespace pharos::network
