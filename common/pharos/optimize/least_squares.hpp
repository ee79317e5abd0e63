// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::optimize {

/// Sums of a linearisation over N unknowns: cost(x + d) = cost + 2 gradient . d + d^T matrix d, with matrix = J^T W J
/// and gradient = J^T W r. Residuals in standard deviations make the matrix the information.
template <int N>
struct NormalEquations {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  Matrix matrix = Matrix::Zero();
  Vector gradient = Vector::Zero();
  double cost = 0.0;

  /// Adds one residual and its derivatives by the unknowns.
  void add(const Vector& row, double residual, double weight = 1.0) {
    add_outer<N>(matrix, row, weight);
    gradient += (weight * residual) * row;
    cost += weight * residual * residual;
  }
};

template <int N>
struct DampedStep {
  Eigen::Matrix<double, N, 1> delta;
  double decrease;
  double smallest_pivot_ratio;
  bool solved;
};

/// (matrix + damping diagonal) delta = -gradient. An unknown without information is not moved while there is damping,
/// and makes the step unsolvable while there is none.
template <int N>
DampedStep<N> damped_step(const NormalEquations<N>& normal, double damping) {
  constexpr double kSingular = 1e-14;     // rounding error of a zero pivot
  constexpr double kMinDiagonal = 1e-12;  // of the largest element, for the damping
  constexpr auto kSize = static_cast<std::size_t>(N);
  PackedSymmetric<kSize> matrix;
  std::array<double, kSize> right;
  double largest = 0.0;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) matrix.lower[static_cast<std::size_t>(i * (i + 1) / 2 + j)] = normal.matrix(i, j);
    right[static_cast<std::size_t>(i)] = -normal.gradient[i];
    largest = std::max(largest, normal.matrix(i, i));
  }
  if (damping > 0.0) {
    for (std::size_t i = 0; i < kSize; ++i) matrix(i, i) += damping * std::max(matrix(i, i), kMinDiagonal * largest);
  }
  const Factorisation<kSize> factor(matrix);
  const std::array<double, kSize> solution = factor.solve(right);
  DampedStep<N> step;
  step.decrease = 0.0;
  for (int i = 0; i < N; ++i) {
    step.delta[i] = solution[static_cast<std::size_t>(i)];
    step.decrease -= normal.gradient[i] * step.delta[i];
  }
  step.smallest_pivot_ratio = factor.smallest_ratio();
  step.solved = step.smallest_pivot_ratio > kSingular;
  return step;
}

/// Base of a problem in double; it adds `Normal linearise(const State&) const` and `State moved(const State&, const
/// Delta&) const`, and hides the constants that it changes.
template <int N, class StateType, class NormalType = NormalEquations<N>>
struct LeastSquares {
  static constexpr int kUnknowns = N;
  using State = StateType;
  using Normal = NormalType;
  using Step = DampedStep<N>;
  using Delta = Eigen::Matrix<double, N, 1>;
  static constexpr double kFirstDamping = 0.0;
  static constexpr bool kEndsWhereSingular = false;
  static constexpr bool kSumsAtEnd = false;

  Step step(const Normal& normal, double damping) const { return damped_step<N>(normal, damping); }
};

}  // namespace pharos::optimize
