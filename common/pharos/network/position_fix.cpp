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
constexpr int kMinChecked = 4;
constexpr double kMinLeft = 1e-3;  // of a row's own variance, beside what the others tell of it
// Of what stations are wrong by, what planes contradict each other by.
constexpr double kContradictingPart = 0.4;
// A displacement of less than this part of the range leaves an angle linear to 2 urad.
constexpr double kLinearPart = 2e-3;

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// A sweep as one angle of the body's position, linearised where the body was taken to be then.
struct Row {
  const PlaneSweep* sweep = nullptr;
  double dt_s = 0.0;
  Vector3 at_m = Vector3::Zero();
  double range_m = 0.0;
  double residual_rad = 0.0;
  double variance = 1.0;
  double weight = 0.0;  // of the last step
  Vector3 gradient = Vector3::Zero();

  Vector9 by_motion() const {
    Vector9 out;
    out << gradient, dt_s * gradient, 0.5 * dt_s * dt_s * gradient;
    return out;
  }
};

struct Motion {
  Vector3 p, v = Vector3::Zero(), a = Vector3::Zero();

  double prior_chi2() const {
    return v.squaredNorm() / (kVelocity_m_s * kVelocity_m_s) +
           a.squaredNorm() / (kAcceleration_m_s2 * kAcceleration_m_s2);
  }
  Vector3 at(double dt_s) const { return p + dt_s * v + 0.5 * dt_s * dt_s * a; }
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

/// What the rows share.
struct Scene {
  const Stations& stations;
  const Target& target;
  const NetworkState& near;
  const HitNoise& noise;
  double diameter_m;
  double turn_rad;
};

/// The mean of a sweep's hits, with the body at `t`. False where it holds none of the target's, or, of a target of
/// several sensors, one alone.
bool linearise_at(const Vector3& t, const Scene& scene, Row& row) {
  const PlaneSweep& sweep = *row.sweep;
  const Station& station = scene.stations[sweep.station];
  const WorldFromStation& T = *station.T_world_station;
  const HitNoise& noise = scene.noise;
  const Matrix3 R = rotation_exp(row.dt_s * scene.near.rate.head<3>()) * scene.near.pose.R;
  Vector3 arm = Vector3::Zero();
  int count = 0;
  row.at_m = t;
  row.range_m = std::max(kFixNearest_m, (t - T.t).norm());
  row.residual_rad = 0.0;
  row.gradient.setZero();
  const double limit_rad = 1.1 * scene.diameter_m / row.range_m + kLoss * noise.own_rad;
  for (const Hit* hit : within_target(sweep, scene.target, limit_rad)) {
    const Vector3 b = R * find_sensor(scene.target, hit->sensor)->position_m;
    const Vector3 p = T.R.transpose() * (t + b - T.t);
    if (!(p.z() > kFixNearest_m)) return false;
    row.residual_rad += hit->angle_rad - raw_angle(station, sweep.plane, p);
    row.gradient += T.R * ideal_gradient(station.generation, sweep.plane, p);
    arm += b;
    ++count;
  }
  if (count < (scene.target.size() > 2 ? 2 : 1)) return false;
  row.residual_rad /= count;
  row.gradient /= count;
  const Vector3 by_turn = arm.cross(row.gradient) / count;
  const double contradiction_rad =
      kContradictingPart *
      std::hypot(station.sigmas.value_or(noise.unstated).contradiction_rad(row.range_m, t), noise.model_rad);
  const double jerk_rad = kJerk_m_s3 * std::abs(row.dt_s * row.dt_s * row.dt_s) / 6.0 * row.gradient.norm();
  row.variance = contradiction_rad * contradiction_rad + jerk_rad * jerk_rad +
                 (noise.own_rad * noise.own_rad + std::pow(noise.sensor_m / row.range_m, 2)) / count +
                 by_turn.dot(scene.near.covariance.topLeftCorner<3, 3>() * by_turn) +
                 scene.turn_rad * scene.turn_rad * by_turn.squaredNorm();
  return std::isfinite(row.residual_rad);
}

// Of a residual of so many sigmas (Cauchy's loss) how much counts.
double loss_weight(double residual_rad, double variance) {
  return 1.0 / (variance * (1.0 + residual_rad * residual_rad / (variance * kLoss * kLoss)));
}

/// What the row leaves with the body at `t`; anew where that is far from where it was linearised.
std::optional<double> residual_at(const Vector3& t, const Scene& scene, Row& row) {
  if (row.range_m == 0.0 || !((t - row.at_m).norm() < kLinearPart * row.range_m)) {
    if (!linearise_at(t, scene, row)) {
      row.range_m = 0.0;
      return std::nullopt;
    }
  }
  return row.residual_rad - row.gradient.dot(t - row.at_m);
}

using Window = StaticVector<Row, kRecentSweeps>;

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

/// The sweeps of the window, which ends with the latest of them: `now_s` may be a sweep's of a station that is left
/// out. Empty where fewer than two stations showed both planes.
Window window_of(const SweepView& recent, const Target& target, double now_s) {
  Window window;
  double latest_s = 0.0;
  for (const PlaneSweep* sweep : recent) latest_s = std::max(latest_s, sweep->time_s());
  std::array<std::array<bool, kPlanes>, kMaxNetworkStations> seen{};
  for (const PlaneSweep* sweep : recent) {
    const double time_s = sweep->time_s();
    if (time_s < latest_s - kWindow_s || !is_clear(*sweep, target)) continue;
    Row row;
    row.sweep = sweep;
    row.dt_s = time_s - now_s;
    window.push_back(row);
    seen[sweep->station][sweep->plane] = true;
  }
  const auto both = std::count_if(seen.begin(), seen.end(), [](const auto& planes) { return planes[0] && planes[1]; });
  if (both < 2 || window.size() < kMinRows) window.clear();
  return window;
}

// Of which at least four sweeps are there.
std::ptrdiff_t stations_checked(const Window& window) {
  std::array<int, kMaxNetworkStations> sweeps{};
  for (const Row& row : window) ++sweeps[row.sweep->station];
  return std::count_if(sweeps.begin(), sweeps.end(), [](int count) { return count >= kMinChecked; });
}

// Where one of the rows is a reflection the body is where the others say: the row that moves it most (Cook's distance
// of one row left out). A row that is far off already pulls little: there the body may be where that row says.
void doubt(const Window& window, const Motion& motion, const FixMatrix& covariance, PositionFix& fix) {
  for (const Row& row : window) {
    if (row.range_m == 0.0) continue;
    const double residual_rad = row.residual_rad - row.gradient.dot(motion.at(row.dt_s) - row.at_m);
    const Vector9 gradient = row.by_motion();
    const Vector9 moved = row.weight * covariance.lazyProduct(gradient);
    const Vector9 by_one = residual_rad / std::max(kMinLeft, 1.0 - gradient.dot(moved)) * moved;
    if (by_one.head<3>().squaredNorm() > fix.by_one.head<3>().squaredNorm()) fix.by_one = by_one;
    if (residual_rad * residual_rad < kLoss * kLoss * row.variance) continue;
    const Vector3 there_m = residual_rad / row.gradient.squaredNorm() * row.gradient;
    fix.far_m2 += there_m * there_m.transpose();
  }
}

// The last row of each plane.
FixPlanes planes_of(const Window& window) {
  FixPlanes planes;
  for (const Row& row : window) {
    if (row.range_m == 0.0) continue;
    const FixPlane own{row.sweep->station, row.sweep->plane, row.sweep->time_s(), row.gradient};
    FixPlane* same = std::find_if(planes.begin(), planes.end(), [&](const FixPlane& other) {
      return other.station == own.station && other.plane == own.plane;
    });
    if (same == planes.end()) {
      planes.push_back(own);
    } else if (same->time_s < own.time_s) {
      *same = own;
    }
  }
  return planes;
}

}  // namespace

std::optional<PositionFix> fix_of(const SweepView& recent, const Stations& stations, const Target& target,
                                  const NetworkState& near, double now_s, const HitNoise& noise, double turn_rad) {
  Window window = window_of(recent, target, now_s);
  if (window.empty()) return std::nullopt;
  const Scene scene{stations, target, near, noise, diameter_of(target), turn_rad};
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
    for (Row& row : window) {
      const std::optional<double> residual_rad = residual_at(motion.at(row.dt_s), scene, row);
      if (!residual_rad) continue;
      const double far = *residual_rad * *residual_rad / (row.variance * kLoss * kLoss);
      row.weight = step == 0 ? 1.0 / row.variance : loss_weight(*residual_rad, row.variance);
      const Vector9 gradient = row.by_motion();
      ++rows;
      if (far > 1.0) ++far_rows;
      square += row.weight * *residual_rad * *residual_rad;
      add_outer<9>(A, gradient, row.weight);
      b += row.weight * *residual_rad * gradient;
      last_rad[row.sweep->station][row.sweep->plane] = std::abs(*residual_rad);
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
    PositionFix fix;
    fix.position_m = motion.p;
    fix.velocity_m_s = motion.v;
    fix.acceleration_m_s2 = motion.a;
    fix.covariance = scatter * *covariance;
    fix.sound = far_rows == 0 && stations_checked(window) >= 2;
    doubt(window, motion, *covariance, fix);
    fix.planes = planes_of(window);
    return fix;
  }
  return std::nullopt;
}

Matrix3 PositionFix::doubted_covariance() const {
  // How probable it is, at most, that the sweep which moves a position most is a reflection.
  constexpr double kReflected = 0.1;
  const Vector3 by_one_m = by_one.head<3>();
  return position_covariance() + far_m2 + kReflected * by_one_m * by_one_m.transpose();
}

}  // namespace pharos::network
