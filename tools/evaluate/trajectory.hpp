// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::evaluate {

// The four frames of a comparison: each side has a world and a body of its own.
struct EstimateWorld {};
struct EstimateBody {};
struct TruthWorld {};
struct TruthBody {};

using EstimatePose = Pose<EstimateWorld, EstimateBody>;
using TruthPose = Pose<TruthWorld, TruthBody>;

/// A pose at a time, with the standard deviations that its maker states (square roots of traces), where he does.
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

/// A pose between two samples and how it changes there: angular velocity and velocity in the world.
template <class WorldFromBody>
struct Moving {
  WorldFromBody pose;
  Vector3 rate_rad_s = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
};

/// The pose at `time_s`: linear in position, slerp in attitude. None outside the trajectory or where the neighbours are
/// more than `max_gap_s` apart (a sample's own time is answered whatever is around it).
template <class WorldFromBody>
std::optional<Moving<WorldFromBody>> pose_at(const Trajectory<WorldFromBody>& trajectory, double time_s,
                                             double max_gap_s);

/// Half of the steps between samples are shorter. 0 for fewer than two samples.
template <class WorldFromBody>
double median_interval_s(const Trajectory<WorldFromBody>& trajectory);

}  // namespace pharos::evaluate
