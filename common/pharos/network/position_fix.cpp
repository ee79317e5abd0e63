// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/position_fix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::network {
namespace {

constexpr double kWindow_s = 0.07;
constexpr double kMaxPriorChi2 = 9.0;
constexpr double kVelocity_m_s = 4.0, kAcceleration_m_s2 = 20.0, kJerk_m_s3 = 500.0;
constexpr double kFixNearest_m = 0.05, kLargestStep_m = 0.5, kConverged_m = 1e-3;
constexpr double kWorstAngle_rad = 0.015;
constexpr int kSteps = 30;
constexpr double kLoss = 3.0;  // Cauchy's, in sigmas
// One row of so many may be beyond: with more it is not told which ones are wrong.
constexpr int kMaxFarRows = 6;
// With fewer a reflection would only look like a velocity.
constexpr std::size_t kMinRows = 6;
// Of what stations are wrong by, what planes contradict each other by.
constexpr double kContradictingPart = 0.4;

using Vector9 = Eigen::Matrix<double, 9, 1>;

struct Row {
  double residual_rad = 0.0;
  double variance = 1.0;
  Vector9 gradient = Vector9::Zero();
};

struct Motion {
  Vector3 p, v = Vector3::Zero(), a = Vector3::Zero();

  double prior_chi2() const {
    return v.squaredNorm() / (kVelocity_m_s * kVelocity_m_s) +
           a.squaredNorm() / (kAcceleration_m_s2 * kAcceleration_m_s2);
  }
  void add(const Vector9& d) {
    p += d.head<3>();
    v += d.segment<3>(3);
    a += d.tail<3>();
  }
};

// Hits of a sweep lie within the target's size about their median, whatever its attitude: others are reflections.
StaticVector<const Hit*, kMaxHitsPerSweep> within_target(const PlaneSweep& sweep, const Target& target,
                                                         double limit_rad) {
  StaticVector<double, kMaxHitsPerSweep> angles;
  for (const Hit& hit : sweep.hits) {
    if (find_sensor(target, hit.sensor) != nullptr) angles.push_back(hit.angle_rad);
  }
  StaticVector<const Hit*, kMaxHitsPerSweep> out;
  if (angles.empty()) return out;
  double* middle = angles.begin() + angles.size() / 2;
  std::nth_element(angles.begin(), middle, angles.end());
  for (const Hit& hit : sweep.hits) {
    if (find_sensor(target, hit.sensor) != nullptr && std::abs(hit.angle_rad - *middle) < limit_rad)
      out.push_back(&hit);
  }
  if (2 * out.size() < angles.size()) out.clear();
  return out;
}

double diameter_of(const Target& target) {
  double square = 0.0;
  for (const SensorPlacement& a : target) {
    for (const SensorPlacement& b : target) square = std::max(square, (a.position_m - b.position_m).squaredNorm());
  }
  return std::sqrt(square);
}

/// The mean of a sweep's hits as one angle of the body's position. Empty where it holds none of the target's, or, of a
/// target of several sensors, one alone.
std::optional<Row> row_of(const PlaneSweep& sweep, const Station& station, const Target& target,
                          const NetworkState& near, const Motion& motion, double now_s, const HitNoise& noise) {
  const WorldFromStation& T = *station.T_world_station;
  const double dt_s = sweep.time_s() - now_s;
  const Vector3 t = motion.p + dt_s * motion.v + 0.5 * dt_s * dt_s * motion.a;
  const Matrix3 R = rotation_exp(dt_s * near.rate.head<3>()) * near.pose.R;
  Row out;
  Vector3 gradient = Vector3::Zero(), arm = Vector3::Zero();
  int count = 0;
  const double range_m = std::max(kFixNearest_m, (t - T.t).norm());
  for (const Hit* hit : within_target(sweep, target, 1.1 * diameter_of(target) / range_m + kLoss * noise.own_rad)) {
    const Vector3 b = R * find_sensor(target, hit->sensor)->position_m;
    const Vector3 p = T.R.transpose() * (t + b - T.t);
    if (!(p.z() > kFixNearest_m)) return std::nullopt;
    out.residual_rad += hit->angle_rad - raw_angle(station, sweep.plane, p);
    gradient += T.R * ideal_gradient(station.generation, sweep.plane, p);
    arm += b;
    ++count;
  }
  if (count < (target.size() > 2 ? 2 : 1)) return std::nullopt;
  out.residual_rad /= count;
  if (!std::isfinite(out.residual_rad)) return std::nullopt;
  gradient /= count;
  arm /= count;
  const Vector3 by_turn = arm.cross(gradient);
  const double contradiction_rad =
      kContradictingPart * station.sigmas.value_or(noise.unstated).contradiction_rad(range_m, t);
  const double jerk_rad = kJerk_m_s3 * std::abs(dt_s * dt_s * dt_s) / 6.0 * gradient.norm();
  out.variance = contradiction_rad * contradiction_rad + jerk_rad * jerk_rad +
                 (noise.own_rad * noise.own_rad + std::pow(noise.sensor_m / range_m, 2)) / count +
                 by_turn.dot(near.covariance.topLeftCorner<3, 3>() * by_turn);
  out.gradient << gradient, dt_s * gradient, 0.5 * dt_s * dt_s * gradient;
  return out;
}

using Window = StaticVector<const PlaneSweep*, kRecentSweeps>;

// Of a sensor that was hit twice one hit is a reflection. A lone hit of several sensors cannot be told from one.
bool is_clear(const PlaneSweep& sweep, const Target& target) {
  std::uint32_t sensors = 0;
  for (const Hit& hit : sweep.hits) {
    const std::uint32_t bit = 1U << (hit.sensor % 32U);
    if ((sensors & bit) != 0) return false;
    sensors |= bit;
  }
  return sweep.hits.size() > 1 || target.size() <= 2;
}

/// The sweeps of the window. Empty where fewer than two stations showed both planes.
Window window_of(const RecentSweeps& recent, const Target& target, double now_s) {
  Window window;
  std::array<std::array<bool, kPlanes>, kMaxNetworkStations> seen{};
  for (const PlaneSweep& sweep : recent) {
    if (sweep.time_s() < now_s - kWindow_s || !is_clear(sweep, target)) continue;
    window.push_back(&sweep);
    seen[sweep.station][sweep.plane] = true;
  }
  const auto both = std::count_if(seen.begin(), seen.end(), [](const auto& planes) { return planes[0] && planes[1]; });
  if (both < 2 || window.size() < kMinRows) window.clear();
  return window;
}

}  // namespace

std::optional<PositionFix> fix_of(const RecentSweeps& recent, const Stations& stations, const Target& target,
                                  const NetworkState& near, const HitNoise& noise) {
  if (recent.empty()) return std::nullopt;
  const double now_s = recent[recent.size() - 1].time_s();
  const Window window = window_of(recent, target, now_s);
  if (window.empty()) return std::nullopt;
  Motion motion{near.pose.t};
  for (int step = 0; step < kSteps; ++step) {
    FixMatrix A = FixMatrix::Zero();
    Vector9 b = Vector9::Zero();
    A.diagonal().head<3>().setConstant(1e-6);
    A.diagonal().segment<3>(3).setConstant(1.0 / (kVelocity_m_s * kVelocity_m_s));
    A.diagonal().tail<3>().setConstant(1.0 / (kAcceleration_m_s2 * kAcceleration_m_s2));
    b.segment<3>(3) = -motion.v / (kVelocity_m_s * kVelocity_m_s);
    b.tail<3>() = -motion.a / (kAcceleration_m_s2 * kAcceleration_m_s2);
    std::array<std::array<double, kPlanes>, kMaxNetworkStations> last_rad{};
    int rows = 0, far_rows = 0;
    double square = 0.0;
    for (const PlaneSweep* sweep : window) {
      const auto row = row_of(*sweep, stations[sweep->station], target, near, motion, now_s, noise);
      if (!row) continue;
      const double far = row->residual_rad * row->residual_rad / (row->variance * kLoss * kLoss);
      const double weight = 1.0 / (row->variance * (step == 0 ? 1.0 : 1.0 + far));
      ++rows;
      if (far > 1.0) ++far_rows;
      square += weight * row->residual_rad * row->residual_rad;
      add_outer<9>(A, row->gradient, weight);
      b += weight * row->residual_rad * row->gradient;
      last_rad[sweep->station][sweep->plane] = std::abs(row->residual_rad);
    }
    const std::optional<FixMatrix> covariance = positive_inverse<9>(A);
    if (!covariance) return std::nullopt;
    const Vector9 d = covariance->lazyProduct(b);
    if (!d.allFinite()) return std::nullopt;
    motion.add(d * std::min(1.0, kLargestStep_m / std::max(1e-12, d.head<3>().norm())));
    if (step == 0 || d.head<3>().norm() > kConverged_m) continue;
    double worst_rad = 0.0;
    for (const auto& planes : last_rad) worst_rad = std::max({worst_rad, planes[0], planes[1]});
    if (worst_rad > kWorstAngle_rad || motion.prior_chi2() > kMaxPriorChi2 || kMaxFarRows * far_rows > rows)
      return std::nullopt;
    // Position alone is free; rates lean on their priors.
    const double scatter = std::max(1.0, square / std::max(1, rows - 3));
    return PositionFix{motion.p, motion.v, motion.a, scatter * *covariance};
  }
  return std::nullopt;
}

}  // namespace pharos::network
