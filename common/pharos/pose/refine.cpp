// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/refine.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

constexpr double kFirstDamping = 1e-3;
constexpr double kDampingGrowth = 10.0;
constexpr double kDampingDecay = 0.1;
constexpr double kLargestDamping = 1e8;
// A fit is given up only when even thrice the decrease that the linear model predicts would leave it hopeless, and only
// after this many steps: far from a minimum the model's prediction is worth little.
constexpr double kOptimism = 3.0;
constexpr int kStepsBeforeGivingUp = 2;

// Decrease of r^T r that the linear model predicts of an undamped step: -g . delta.
double predicted_decrease(const std::array<double, 6>& gradient, const std::array<double, 6>& delta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum -= gradient[i] * delta[i];
  return sum;
}

std::array<double, 6> negated(const std::array<double, 6>& v) { return {-v[0], -v[1], -v[2], -v[3], -v[4], -v[5]}; }

}  // namespace

LighthouseFromBody stepped(const LighthouseFromBody& pose, const std::array<double, 6>& delta) {
  const Vector3 half(0.5 * delta[0], 0.5 * delta[1], 0.5 * delta[2]);
  const double scale = 2.0 / (1.0 + half.squaredNorm());
  LighthouseFromBody moved;
  for (int c = 0; c < 3; ++c) {
    const Vector3 column = pose.R.col(c);
    const Vector3 turned = half.cross(column);
    moved.R.col(c) = column + scale * (turned + half.cross(turned));
  }
  moved.t = pose.t + Vector3(delta[3], delta[4], delta[5]);
  return moved;
}

LighthouseFromBody gauss_newton_step(const Sightings& sightings, const LighthouseFromBody& pose, Residual residual) {
  const NormalEquations normal = linearise(sightings, pose, residual);
  return stepped(pose, Factorisation<6>(normal.matrix).solve(negated(normal.gradient)));
}

Fit refine(const Sightings& sightings, const LighthouseFromBody& start, Residual residual, const RefineLimits& limits) {
  Fit fit;
  fit.pose = start;
  fit.normal = linearise(sightings, start, residual);
  if (!(fit.normal.cost < 1e300)) return fit;
  double damping = 0.0;
  while (fit.iterations < limits.max_iterations) {
    ++fit.iterations;
    const Factorisation<6> factor(fit.normal.matrix, damping);
    fit.smallest_pivot_ratio = factor.smallest_ratio();
    const std::array<double, 6> delta = factor.solve(negated(fit.normal.gradient));
    const double decrease = predicted_decrease(fit.normal.gradient, delta);
    if (damping == 0.0 && decrease < limits.tolerance) {
      // The step is worth taking, its linearisation is not worth repeating.
      fit.pose = stepped(fit.pose, delta);
      fit.normal.cost = std::fmax(0.0, fit.normal.cost - decrease);
      fit.converged = true;
      return fit;
    }
    if (fit.iterations > kStepsBeforeGivingUp && fit.normal.cost - kOptimism * decrease > limits.hopeless_cost)
      return fit;
    const LighthouseFromBody trial = stepped(fit.pose, delta);
    const NormalEquations at_trial = linearise(sightings, trial, residual);
    if (at_trial.cost <= fit.normal.cost) {
      fit.pose = trial;
      fit.normal = at_trial;
      damping = damping > kFirstDamping ? damping * kDampingDecay : 0.0;
    } else {
      damping = damping > 0.0 ? damping * kDampingGrowth : kFirstDamping;
      if (damping > kLargestDamping) {
        fit.converged = decrease < limits.tolerance;
        return fit;
      }
    }
  }
  return fit;
}

}  // namespace pharos::pose
