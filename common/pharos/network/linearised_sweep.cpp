// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/linearised_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::network {
namespace {

constexpr double kNearest_m = 0.05;  // nearer to a station no sensor is lit
constexpr double kHitGate = 5.0;     // standard deviations beyond which a hit does not belong to this body
// A photodiode sees nothing from behind; its normal may be wrong by so much (sine), beside the attitude's own sigmas.
constexpr double kBehind = 0.1, kBehindSigmas = 3.0;

// Sensors must be placed this much better than the target is large for its apparent size to tell the range: errors of
// placement and a tilt are the same in every sweep, and 1 % of size is 30 mm of range at 3 m.
constexpr double kRangingRatio = 0.004;
// What stations are wrong by is not noise: as common noise this part of it lets planes that contradict each other
// share, without slowing the filter down. The whole of it is in a result's covariance.
constexpr double kFilteredPart = 0.4;

double radius_of(const Target& target) {
  double square = 0.0;
  for (const SensorPlacement& sensor : target) square = std::max(square, sensor.position_m.squaredNorm());
  return std::sqrt(square);
}

struct Candidate {
  std::uint8_t sensor = 0;
  double residual_rad = 0.0;
  double variance = 0.0;
  double dt_s = 0.0;
  bool from_behind = false;
  Vector3 q_m = Vector3::Zero();       // from the body's origin to the sensor, world frame
  Vector3 gradient = Vector3::Zero();  // of the angle by the point, world frame
};

using Candidates = StaticVector<Candidate, kMaxHitsPerSweep>;

double median_of(const Candidates& candidates) {
  StaticVector<double, kMaxHitsPerSweep> values;
  for (const Candidate& c : candidates) values.push_back(c.residual_rad);
  double* middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// For each sensor the candidate whose residual is nearest to `centre`.
Candidates nearest_to(double centre, const Candidates& all) {
  Candidates chosen;
  for (const Candidate& candidate : all) {
    Candidate* same =
        std::find_if(chosen.begin(), chosen.end(), [&](const Candidate& c) { return c.sensor == candidate.sensor; });
    if (same == chosen.end()) {
      if (chosen.size() < kMaxSensors) chosen.push_back(candidate);
    } else if (std::abs(candidate.residual_rad - centre) < std::abs(same->residual_rad - centre)) {
      *same = candidate;
    }
  }
  return chosen;
}

// Light that came through the body: of another attitude.
bool is_from_behind(const SensorPlacement& sensor, const Vector3& from_m, const NetworkState& state) {
  if (!sensor.has_normal()) return false;
  const Vector3 normal = state.pose.R * sensor.normal, ray = from_m.normalized();
  const Vector3 by_turn = normal.cross(ray);
  const double sigma = std::sqrt(std::max(0.0, by_turn.dot(state.covariance.topLeftCorner<3, 3>() * by_turn)));
  return normal.dot(ray) > kBehind + kBehindSigmas * sigma;
}

Vector6 by_pose(const Candidate& c) {
  Vector6 h;
  h << c.q_m.cross(c.gradient), c.gradient;
  return h;
}

// Leaves out what departs from the common shift.
void gate(Candidates& hits, const Matrix6& pose_covariance) {
  if (hits.size() < 2) return;
  const double centre = median_of(hits);
  Vector6 mean = Vector6::Zero();
  for (const Candidate& hit : hits) mean += by_pose(hit) / static_cast<double>(hits.size());
  for (std::size_t i = hits.size(); i-- > 0;) {
    const Vector6 h = by_pose(hits[i]) - mean;
    const double spread = h.dot(pose_covariance * h) + 2.0 * hits[i].variance;
    const double departure = hits[i].residual_rad - centre;
    if (departure * departure > kHitGate * kHitGate * spread) hits.erase_unordered(i);
  }
}

// Of a small target only the mean of the hits tells of the position: its apparent size does not tell the range.
void fill_row(const Candidate& c, const Vector3* position_gradient, HitRows& rows, Eigen::Index row) {
  Vector6 h = by_pose(c);
  if (position_gradient != nullptr) h.tail<3>() = *position_gradient;
  rows.row(row).segment<6>(kPoseAt) = h.transpose();
  rows.row(row).segment<6>(kRateAt) = c.dt_s * h.transpose();
}

}  // namespace

bool tells_range(const Target& target, const HitNoise& noise) {
  return noise.sensor_m < kRangingRatio * radius_of(target);
}

LinearisedSweep linearise(const PlaneSweep& sweep, const Stations& stations, const Target& target,
                          const NetworkState& state, double time_s, const HitNoise& noise) {
  LinearisedSweep out;
  out.station = sweep.station;
  out.plane = sweep.plane;
  out.time_s = time_s;
  out.at = state;
  const Station& station = stations[sweep.station];
  const WorldFromStation& T_world_station = *station.T_world_station;
  const StationSigmas sigmas = station.sigmas.value_or(noise.unstated);
  double nearest_m = 1e9;
  Candidates candidates;
  double motion_rad_s = 0.0;
  for (const Hit& hit : sweep.hits) {
    const SensorPlacement* sensor = find_sensor(target, hit.sensor);
    if (sensor == nullptr) continue;
    Candidate c;
    c.sensor = hit.sensor;
    c.dt_s = hit.time_s - time_s;
    const Vector3 b = state.pose.R * sensor->position_m;
    const Vector3 velocity = state.rate.tail<3>() + state.rate.head<3>().cross(b);
    c.q_m = b + c.dt_s * state.rate.head<3>().cross(b);
    const Vector3 from_m = state.pose.t + b + c.dt_s * velocity - T_world_station.t;
    const Vector3 p = T_world_station.R.transpose() * from_m;
    if (!(p.z() > kNearest_m)) continue;
    nearest_m = std::min(nearest_m, p.norm());
    c.from_behind = is_from_behind(*sensor, from_m, state);
    c.gradient = T_world_station.R * ideal_gradient(station.generation, sweep.plane, p);
    c.residual_rad = hit.angle_rad - raw_angle(station, sweep.plane, p);
    // A station that is turned sees the body turned: its sensors are shifted against each other.
    const double placed_rad = std::hypot(noise.sensor_m, sigmas.rotation_rad * sensor->position_m.norm()) / p.norm();
    c.variance = noise.own_rad * noise.own_rad + placed_rad * placed_rad;
    motion_rad_s = std::max(motion_rad_s, std::abs(c.gradient.dot(velocity)));
    if (std::isfinite(c.residual_rad)) candidates.push_back(c);
  }
  Candidates hits;
  if (!candidates.empty()) {
    hits = nearest_to(0.0, candidates);
    out.sensors = static_cast<int>(hits.size());
    if (candidates.size() > hits.size()) hits = nearest_to(median_of(hits), candidates);
    for (std::size_t i = hits.size(); i-- > 0;) {
      if (hits[i].from_behind) hits.erase_unordered(i);
    }
    gate(hits, state.covariance.topLeftCorner<6, 6>());
  }
  const auto count = static_cast<Eigen::Index>(hits.size());
  out.common_variance =
      noise.common_rad * noise.common_rad + std::pow(noise.time_s * motion_rad_s, 2) +
      std::pow(kFilteredPart * std::hypot(sigmas.contradiction_rad(nearest_m, state.pose.t), noise.model_rad), 2);
  out.rows.resize(count, kObserved);
  out.residual.resize(count);
  out.variance.resize(count);
  for (const Candidate& c : hits) out.gradient += c.gradient / static_cast<double>(count);
  const bool ranging = tells_range(target, noise);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Candidate& c = hits[static_cast<std::size_t>(i)];
    fill_row(c, ranging ? nullptr : &out.gradient, out.rows, i);
    out.residual[i] = c.residual_rad;
    out.variance[i] = c.variance;
  }
  return out;
}

}  // namespace pharos::network
