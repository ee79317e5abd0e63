// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/refine.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

// Nielsen's rule (IMM-REP-1999-05) for the damping, and where it starts and ends.
constexpr double kFirstDamping = 1e-3;
constexpr double kNoDamping = 1e-5;
constexpr double kLargestDamping = 1e8;
// A fit is given up only when even thrice the decrease that the linear model predicts would leave it hopeless, and only
// after this many steps: far from a minimum the model's prediction is worth little.
constexpr double kOptimism = 3.0;
constexpr int kStepsBeforeGivingUp = 1;

// Decrease of r^T r that the linear model predicts of an undamped step: -g . delta.
double predicted_decrease(const std::array<double, 6>& gradient, const std::array<double, 6>& delta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum -= gradient[i] * delta[i];
  return sum;
}

std::array<double, 6> negated(const std::array<double, 6>& v) { return {-v[0], -v[1], -v[2], -v[3], -v[4], -v[5]}; }

// Damping of the rotation is the same about all axes, by the best determined one: straight on to a plane the cost is so
// flat in tilt that tilt's own diagonal element would not hold a step back. Translation is damped by its own diagonal.
PackedSymmetric<6> damped(const PackedSymmetric<6>& matrix, double damping) {
  PackedSymmetric<6> sum = matrix;
  const double rotation = std::fmax(matrix(0, 0), std::fmax(matrix(1, 1), matrix(2, 2)));
  for (std::size_t i = 0; i < 3; ++i) {
    sum(i, i) += damping * rotation;
    sum(i + 3, i + 3) += damping * matrix(i + 3, i + 3);
  }
  return sum;
}

class Damping {
 public:
  double value() const { return value_; }
  bool none() const { return value_ == 0.0; }
  /// After a step that lowered the cost by `gain` times what the linear model predicted.
  void succeeded(double gain) {
    const double excess = 2.0 * gain - 1.0;
    value_ *= std::fmax(1.0 / 3.0, 1.0 - excess * excess * excess);
    if (value_ < kNoDamping) value_ = 0.0;
    growth_ = 2.0;
  }
  /// After one that did not; false where there is no more damping to try.
  bool failed() {
    value_ = value_ > 0.0 ? value_ * growth_ : kFirstDamping;
    growth_ *= 2.0;
    return value_ < kLargestDamping;
  }

 private:
  double value_ = 0.0;
  double growth_ = 2.0;
};

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
  Damping damping;
  while (fit.iterations < limits.max_iterations) {
    ++fit.iterations;
    const Factorisation<6> factor(damping.none() ? fit.normal.matrix : damped(fit.normal.matrix, damping.value()));
    fit.smallest_pivot_ratio = factor.smallest_ratio();
    const std::array<double, 6> delta = factor.solve(negated(fit.normal.gradient));
    const double decrease = predicted_decrease(fit.normal.gradient, delta);
    if (damping.none() && decrease < limits.tolerance) {
      // The step is worth taking, its linearisation is not worth repeating.
      fit.pose = stepped(fit.pose, delta);
      fit.normal.cost = std::fmax(0.0, fit.normal.cost - decrease);
      fit.converged = true;
      return fit;
    }
    if (!damping.none() && decrease < limits.tolerance) {
      damping = {};  // whether this is the minimum, only an undamped step can tell
      continue;
    }
    if (fit.iterations > kStepsBeforeGivingUp && fit.normal.cost - kOptimism * decrease > limits.hopeless_cost) {
      return fit;
    }
    const LighthouseFromBody trial = stepped(fit.pose, delta);
    const NormalEquations at_trial = linearise(sightings, trial, residual);
    if (at_trial.cost <= fit.normal.cost) {
      damping.succeeded((fit.normal.cost - at_trial.cost) / decrease);
      fit.pose = trial;
      fit.normal = at_trial;
    } else if (!damping.failed()) {
      fit.converged = decrease < limits.tolerance;
      return fit;
    }
  }
  return fit;
}

}  // namespace pharos::pose
