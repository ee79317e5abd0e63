// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos {

/// Mean of independent poses of a stationary body, with its covariance.
template <class Parent, class Child>
struct MeanPose {
  Pose<Parent, Child> pose;
  /// sum(C_i) / N^2, widened by `reduced_chi2` where that is more than 1. Rotation (rad) before translation (m).
  Matrix6 covariance = Matrix6::Zero();
  /// Of the poses about their mean under their own covariances; 1 for a single one. Far above 1: the body was not
  /// stationary.
  double reduced_chi2 = 1.0;
};

template <class Parent, class Child>
MeanPose(const Pose<Parent, Child>&) -> MeanPose<Parent, Child>;

/// The pose that minimises the sum of squared differences: the mean of positions, and of rotations as small rotations
/// about it. `estimates` is not empty; its items have a `pose` and a positive definite `covariance`. Three or four
/// iterations over all of them.
template <class Estimates>
auto mean_of_poses(const Estimates& estimates) {
  constexpr int kMaxSteps = 10;
  constexpr double kSmallStep_rad = 1e-12;
  const auto count = static_cast<double>(estimates.size());
  MeanPose result{estimates.front().pose};
  for (int step = 0; step < kMaxSteps; ++step) {
    Vector6 sum = Vector6::Zero();
    for (const auto& one : estimates) sum += pose_difference(one.pose, result.pose);
    result.pose = result.pose.moved_by(sum / count);
    if (sum.template head<3>().norm() < kSmallStep_rad * count) break;
  }
  double squares = 0.0;
  for (const auto& one : estimates) {
    result.covariance += one.covariance / (count * count);
    const Vector6 delta = pose_difference(one.pose, result.pose);
    squares += mahalanobis_squared<6>(delta, one.covariance);
  }
  if (count > 1.0) result.reduced_chi2 = squares / (6.0 * (count - 1.0));
  if (std::isfinite(result.reduced_chi2)) result.covariance *= std::max(1.0, result.reduced_chi2);
  return result;
}

}  // namespace pharos
