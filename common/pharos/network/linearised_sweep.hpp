// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/target.hpp"
#include "pharos/network/network_state.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::network {

inline constexpr int kMaxSweepHits = static_cast<int>(kMaxSensors);

/// Derivatives by the errors of pose and rate.
inline constexpr Eigen::Index kObserved = 12;
using HitVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxSweepHits, 1>;
using HitSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxSweepHits, kMaxSweepHits>;
using HitRows = Eigen::Matrix<double, Eigen::Dynamic, kObserved, Eigen::RowMajor, kMaxSweepHits, kObserved>;

/// Hits of a sweep, at most one a sensor, linearised at a state that holds at `time_s`, each at its own instant:
/// p = R b + t + (t_i - time) (v + omega x R b), angle = raw_angle(station, R_s^T (p - t_s)).
struct LinearisedSweep {
  std::size_t station = 0;
  std::size_t plane = 0;
  double time_s = 0.0;
  NetworkState at;     // means only: where it was linearised
  HitRows rows;        // derivatives of each angle
  HitVector residual;  // measured - predicted, rad
  HitVector variance;  // own, rad^2
  double common_variance = 0.0;
  Vector3 gradient = Vector3::Zero();  // mean of the hits', by the body's position, rad/m
  int sensors = 0;                     // that were hit

  int hits() const { return static_cast<int>(residual.size()); }
};

/// Linearises a sweep. Of a sensor's candidates (reflections) the one is taken whose residual is nearest to the sweep's
/// median; hits that depart from the median by more than the covariance and the noise allow are left out.
LinearisedSweep linearise(const PlaneSweep& sweep, const Stations& stations, const Target& target,
                          const NetworkState& state, double time_s, const HitNoise& noise);

/// Whether a target is large enough, beside what its sensors' places are known to, that its apparent size tells its
/// range.
bool tells_range(const Target& target, const HitNoise& noise);

}  // namespace pharos::network
