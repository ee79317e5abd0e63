// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/descent.hpp"
#include "pharos/pose/linearise.hpp"

namespace pharos::pose {

/// Share of sigma^2 by which a last step may still lower r^T r: the pose then is within 0.01 sigma of the minimum.
inline constexpr double kConvergedShare = 1e-4;

/// The pose moved by delta. The rotation uses Cayley's map, which agrees with exp to the third order and needs neither
/// sine nor cosine; only the size of a step depends on it, never the minimum.
LighthouseFromBody stepped(const LighthouseFromBody& pose, const std::array<double, 6>& delta);

/// One step of a descent.
struct DoubleStep {
  std::array<double, 6> delta;
  double decrease;  // of r^T r, that the linear model predicts of an undamped step
  double smallest_pivot_ratio;
  bool solved = true;  // double always can; the integers may not
};

/// The system of equations that `descend` and `both_minima` work on, in double.
class DoubleSystem {
 public:
  using Pose = LighthouseFromBody;
  using Normal = NormalEquations;
  using Step = DoubleStep;
  static constexpr double kConverged = kConvergedShare;
  static constexpr bool kAsksForValley = false;

  DoubleSystem(const Sightings& sightings, Residual residual) : sightings_(sightings), residual_(residual) {}

  NormalEquations linearise(const Pose& pose) const { return pose::linearise(sightings_, pose, residual_); }
  DoubleStep step(const NormalEquations& normal, double damping) const;
  Pose stepped(const Pose& pose, const DoubleStep& step) const { return pose::stepped(pose, step.delta); }
  Pose mirrored(const Pose& pose) const;
  bool ahead(const Pose& pose) const { return (pose * sightings_.body_centroid()).z() > 0.0; }
  /// Squared distance of two poses, d^T N d, by the first one's information.
  double square_between(const Pose& a, const NormalEquations& normal, const Pose& b) const;
  int rows() const { return sightings_.rows(); }

 private:
  const Sightings& sightings_;
  Residual residual_;
};

using Fit = Descent<DoubleSystem>;

Fit refine(const Sightings& sightings, const LighthouseFromBody& start, Residual residual, const RefineLimits& limits);

/// One undamped step from the pose.
LighthouseFromBody gauss_newton_step(const Sightings& sightings, const LighthouseFromBody& pose, Residual residual);

}  // namespace pharos::pose
