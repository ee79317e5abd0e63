// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {

bool Trajectory::lit(double) const { return true; }

StationaryTrajectory::StationaryTrajectory(std::vector<RoomFromBody> poses, double hold_s, double gap_s)
    : poses_(std::move(poses)), hold_s_(hold_s), gap_s_(gap_s) {}

std::size_t StationaryTrajectory::index_at(double time_s) const {
  if (time_s <= 0.0) return 0;
  return std::min(static_cast<std::size_t>(time_s / hold_s_), poses_.size() - 1);
}

RoomFromBody StationaryTrajectory::at(double time_s) const { return poses_[index_at(time_s)]; }

bool StationaryTrajectory::lit(double time_s) const {
  const std::size_t index = index_at(time_s);
  return index + 1 == poses_.size() || time_s < static_cast<double>(index + 1) * hold_s_ - gap_s_;
}

CarriedTrajectory::CarriedTrajectory(std::vector<RoomFromBody> poses, double hold_s, double move_s)
    : poses_(std::move(poses)), hold_s_(hold_s), move_s_(move_s) {}

RoomFromBody CarriedTrajectory::at(double time_s) const {
  const double stop = std::clamp(std::floor(time_s / hold_s_), 0.0, static_cast<double>(poses_.size() - 1));
  const auto index = static_cast<std::size_t>(stop);
  const double moved_s = time_s - (stop + 1.0) * hold_s_ + move_s_;
  if (index + 1 == poses_.size() || moved_s <= 0.0) return poses_[index];
  // The smoothest step: speed and acceleration are zero at both ends.
  const double u = std::min(moved_s / move_s_, 1.0);
  const double way = u * u * u * (10.0 + u * (6.0 * u - 15.0));
  const RoomFromBody& from = poses_[index];
  const RoomFromBody& to = poses_[index + 1];
  return {rotation_exp(way * rotation_log(to.R * from.R.transpose())) * from.R, from.t + way * (to.t - from.t)};
}

double Sine::at(double time_s) const {
  return amplitude == 0.0 ? 0.0 : amplitude * std::sin(kTwoPi * frequency_hz * time_s + phase_rad);
}

SineTrajectory::SineTrajectory(const RoomFromBody& centre, const std::array<Sine, 3>& position_m,
                               const std::array<Sine, 3>& rotation_rad, double spin_rad_s)
    : centre_(centre), position_m_(position_m), rotation_rad_(rotation_rad), spin_rad_s_(spin_rad_s) {}

RoomFromBody SineTrajectory::at(double time_s) const {
  Vector3 offset;
  Vector3 rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    offset[row] = position_m_[i].at(time_s);
    rotation[row] = rotation_rad_[i].at(time_s);
  }
  const Matrix3 spin = rotation_exp(Vector3(0.0, 0.0, spin_rad_s_ * time_s));
  return {centre_.R * spin * rotation_exp(rotation), centre_.t + offset};
}

WaypointTrajectory::WaypointTrajectory(const std::vector<Waypoint>& waypoints) {
  for (const Waypoint& waypoint : waypoints) {
    const Quaternion q(waypoint.pose.R);
    Coordinates value;
    value << waypoint.pose.t, q.coeffs();
    if (!values_.empty() && value.tail<4>().dot(values_.back().tail<4>()) < 0.0) value.tail<4>() *= -1.0;
    times_s_.push_back(waypoint.time_s);
    values_.push_back(value);
  }
  // Second derivatives of the natural cubic spline: a tridiagonal system, solved by forward sweep and substitution.
  const std::size_t n = values_.size();
  curvatures_.assign(n, Coordinates::Zero());
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = times_s_[i] - times_s_[i - 1];
    const double after = times_s_[i + 1] - times_s_[i];
    const Coordinates bend = 6.0 * ((values_[i + 1] - values_[i]) / after - (values_[i] - values_[i - 1]) / before);
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    curvatures_[i] = (bend - before * curvatures_[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 2;) curvatures_[i - 1] -= upper[i - 1] * curvatures_[i];
}

RoomFromBody WaypointTrajectory::at(double time_s) const {
  Coordinates value = values_.front();
  if (values_.size() > 1) {
    const double time = std::clamp(time_s, times_s_.front(), times_s_.back());
    const auto after = std::upper_bound(times_s_.begin(), times_s_.end() - 1, time);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times_s_.begin(), 1));
    const double step = times_s_[i] - times_s_[i - 1];
    const double b = (time - times_s_[i - 1]) / step;
    const double a = 1.0 - b;
    value = a * values_[i - 1] + b * values_[i] +
            step * step / 6.0 * ((a * a * a - a) * curvatures_[i - 1] + (b * b * b - b) * curvatures_[i]);
  }
  return {Quaternion(Eigen::Vector4d(value.tail<4>())).normalized().toRotationMatrix(), value.head<3>()};
}

}  // namespace pharos::sim
