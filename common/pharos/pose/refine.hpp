// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/linearise.hpp"

namespace pharos::pose {

/// Where a descent stands.
struct Fit {
  LighthouseFromBody pose;
  NormalEquations normal;             // at the pose, or at one that differs by less than the tolerance
  double smallest_pivot_ratio = 1.0;  // of the last step's normal matrix
  int iterations = 0;
  bool converged = false;
};

struct RefineLimits {
  int max_iterations = 50;
  /// Stop when a step's predicted decrease of r^T r falls below this (rad^2).
  double tolerance = 0.0;
  /// Give up (not converged) when a step shows that r^T r will stay above this.
  double hopeless_cost = 1e300;
};

/// Share of sigma^2 by which a last step may still lower r^T r: the pose then is within 0.01 sigma of the minimum.
inline constexpr double kConvergedShare = 1e-4;

/// Levenberg-Marquardt on the left error of the pose. The first step is undamped (Gauss-Newton); damping enters only
/// where a step fails to lower the cost, so a good start costs about three linearisations.
Fit refine(const Sightings& sightings, const LighthouseFromBody& start, Residual residual, const RefineLimits& limits);

/// One undamped step from the pose.
LighthouseFromBody gauss_newton_step(const Sightings& sightings, const LighthouseFromBody& pose, Residual residual);

/// The pose moved by delta. The rotation uses Cayley's map, which agrees with exp to the third order and needs neither
/// sine nor cosine; only the size of a step depends on it, never the minimum.
LighthouseFromBody stepped(const LighthouseFromBody& pose, const std::array<double, 6>& delta);

}  // namespace pharos::pose
