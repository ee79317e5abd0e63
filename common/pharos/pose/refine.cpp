// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/refine.hpp"

#include "pharos/pose/second_minimum.hpp"

namespace pharos::pose {
namespace {

// Decrease of r^T r predicted by the linear model for an undamped step: -g . delta.
double predicted_decrease(const std::array<double, 6>& gradient, const std::array<double, 6>& delta) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum -= gradient[i] * delta[i];
  return sum;
}

std::array<double, 6> negated(const std::array<double, 6>& v) { return {-v[0], -v[1], -v[2], -v[3], -v[4], -v[5]}; }

// Damping of the rotation is the same about all axes, by the best determined one: straight on to a plane the cost is so
// flat in tilt that tilt's own diagonal element would not limit a step. Translation is damped by its own diagonal.
PackedSymmetric<6> damped(const PackedSymmetric<6>& matrix, double damping) {
  PackedSymmetric<6> sum = matrix;
  const double rotation = std::fmax(matrix(0, 0), std::fmax(matrix(1, 1), matrix(2, 2)));
  for (std::size_t i = 0; i < 3; ++i) {
    sum(i, i) += damping * rotation;
    sum(i + 3, i + 3) += damping * matrix(i + 3, i + 3);
  }
  return sum;
}

}  // namespace

LighthouseFromBody moved(const LighthouseFromBody& pose, const std::array<double, 6>& delta) {
  const Vector3 half(0.5 * delta[0], 0.5 * delta[1], 0.5 * delta[2]);
  const double scale = 2.0 / (1.0 + half.squaredNorm());
  LighthouseFromBody to;
  for (int c = 0; c < 3; ++c) {
    const Vector3 column = pose.R.col(c);
    const Vector3 turned = half.cross(column);
    to.R.col(c) = column + scale * (turned + half.cross(turned));
  }
  to.t = pose.t + Vector3(delta[3], delta[4], delta[5]);
  return to;
}

DoubleStep DoubleSystem::step(const NormalEquations& normal, double damping) const {
  const Factorisation<6> factor(damping == 0.0 ? normal.matrix : damped(normal.matrix, damping));
  DoubleStep step;
  step.delta = factor.solve(negated(normal.gradient));
  step.decrease = predicted_decrease(normal.gradient, step.delta);
  step.smallest_pivot_ratio = factor.smallest_ratio();
  return step;
}

LighthouseFromBody DoubleSystem::mirrored(const LighthouseFromBody& pose) const {
  return mirrored_in_depth(table_, pose);
}

double DoubleSystem::square_between(const LighthouseFromBody& a, const NormalEquations& normal,
                                    const LighthouseFromBody& b) const {
  const Vector6 d = pose_difference(b, a);
  double square = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) square += d[static_cast<int>(i)] * normal.matrix(i, j) * d[static_cast<int>(j)];
  }
  return square;
}

LighthouseFromBody gauss_newton_step(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual) {
  const DoubleSystem system(table, residual);
  return system.moved(pose, system.step(system.linearise(pose), 0.0).delta);
}

Fit refine(const ObservationTable& table, const LighthouseFromBody& start, Residual residual,
           const optimize::DescentSettings& settings) {
  Fit fit;
  optimize::descend(DoubleSystem(table, residual), start, settings, fit);
  return fit;
}

}  // namespace pharos::pose
