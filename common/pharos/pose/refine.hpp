// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/optimize/descent.hpp"
#include "pharos/pose/linearise.hpp"

namespace pharos::pose {

/// Fraction of sigma^2 by which a last step may still lower r^T r: the pose is then within 0.01 sigma of the minimum.
inline constexpr double kConvergedFraction = 1e-4;

/// The pose moved by delta: the retraction of both minima's descent. The rotation uses Cayley's map, which agrees with
/// exp to the third order and needs neither sine nor cosine; it affects only the size of a step, never the minimum.
LighthouseFromBody moved(const LighthouseFromBody& pose, const std::array<double, 6>& delta);

/// One step of a descent.
struct DoubleStep {
  std::array<double, 6> delta;
  double decrease;  // of r^T r, that the linear model predicts of an undamped step
  double smallest_pivot_ratio;
  bool solved = true;  // always true in double; the integers may fail
};

/// The problem that `descend` and `both_minima` work on, in double.
class DoubleSystem {
 public:
  using State = LighthouseFromBody;
  using Normal = NormalEquations;
  using Step = DoubleStep;
  static constexpr double kFirstDamping = 0.0;
  static constexpr bool kEndsWhereSingular = true;  // never: see Factorisation
  static constexpr bool kSumsAtEnd = false;
  static constexpr double kConverged = kConvergedFraction;
  static constexpr bool kChecksBasin = false;

  DoubleSystem(const ObservationTable& table, Residual residual) : table_(table), residual_(residual) {}

  NormalEquations linearise(const State& pose) const { return pose::linearise(table_, pose, residual_); }
  DoubleStep step(const NormalEquations& normal, double damping) const;
  State moved(const State& pose, const std::array<double, 6>& delta) const { return pose::moved(pose, delta); }
  State mirrored(const State& pose) const;
  bool ahead(const State& pose) const { return (pose * table_.body_centroid()).z() > 0.0; }
  /// Squared distance of two poses, d^T N d, by the first one's information.
  double square_between(const State& a, const NormalEquations& normal, const State& b) const;
  int rows() const { return table_.rows(); }

 private:
  const ObservationTable& table_;
  Residual residual_;
};

using Fit = optimize::Descent<DoubleSystem>;

Fit refine(const ObservationTable& table, const LighthouseFromBody& start, Residual residual,
           const optimize::DescentSettings& settings);

/// One undamped step from the pose.
LighthouseFromBody gauss_newton_step(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual);

}  // namespace pharos::pose
