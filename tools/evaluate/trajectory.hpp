// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::evaluate {

// The four frames of a comparison: each side has its own world and body.
struct EstimateWorld {};
struct EstimateBody {};
struct TruthWorld {};
struct TruthBody {};

using EstimatePose = Pose<EstimateWorld, EstimateBody>;
using TruthPose = Pose<TruthWorld, TruthBody>;

/// A pose at a time, with its stated standard deviations (square roots of traces), where given.
template <class WorldFromBody>
struct Sample {
  double time_s = 0.0;
  WorldFromBody pose;
  std::optional<double> sigma_rotation_rad;
  std::optional<double> sigma_position_m;
};

/// Poses in the order of time, each later than the one before.
template <class WorldFromBody>
using Trajectory = std::vector<Sample<WorldFromBody>>;

/// A pose between two samples, with angular velocity and velocity in the world frame.
template <class WorldFromBody>
struct Moving {
  WorldFromBody pose;
  Vector3 rate_rad_s = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
};

/// The pose at `time_s`: linear in position, slerp in attitude. None outside the trajectory or where the neighbours are
/// more than `max_gap_s` apart (at the time of a sample itself there is always a pose).
template <class WorldFromBody>
std::optional<Moving<WorldFromBody>> pose_at(const Trajectory<WorldFromBody>& trajectory, double time_s,
                                             double max_gap_s);

/// Median step between samples, s. 0 for fewer than two samples.
template <class WorldFromBody>
double median_interval_s(const Trajectory<WorldFromBody>& trajectory);

}  // namespace pharos::evaluate
