// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "pharos/optimize/descent.hpp"
#include "pharos/optimize/least_squares.hpp"

namespace pharos::optimize {

template <int N>
using VectorOf = Eigen::Matrix<double, N, 1>;

/// Problems whose state is a plain vector.
template <int N>
struct VectorProblem : LeastSquares<N, VectorOf<N>> {
  VectorOf<N> moved(const VectorOf<N>& x, const VectorOf<N>& delta) const { return x + delta; }
};

/// Residuals A x - b, 2 N of them.
template <int N>
struct Linear : VectorProblem<N> {
  Eigen::Matrix<double, 2 * N, N> A;
  VectorOf<2 * N> b;

  explicit Linear(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 2 * N; ++i) {
      for (int j = 0; j < N; ++j) A(i, j) = uniform(random);
      b[i] = uniform(random);
    }
  }
  NormalEquations<N> linearise(const VectorOf<N>& x) const {
    NormalEquations<N> normal;
    const VectorOf<2 * N> r = A * x - b;
    for (int i = 0; i < 2 * N; ++i) normal.add(A.row(i).transpose(), r[i]);
    return normal;
  }
};

/// Rosenbrock's chain: (10 (y - x^2), 1 - x, 10 (z - y^2), 1 - y), a curved valley to (1, 1, 1).
struct Rosenbrock : VectorProblem<3> {
  NormalEquations<3> linearise(const VectorOf<3>& x) const {
    NormalEquations<3> normal;
    normal.add({-20.0 * x[0], 10.0, 0.0}, 10.0 * (x[1] - x[0] * x[0]));
    normal.add({-1.0, 0.0, 0.0}, 1.0 - x[0]);
    normal.add({0.0, -20.0 * x[1], 10.0}, 10.0 * (x[2] - x[1] * x[1]));
    normal.add({0.0, -1.0, 0.0}, 1.0 - x[1]);
    return normal;
  }
};

/// amplitude exp(-rate t) + offset at 20 times, fitted to samples with noise. Rates are `unit` to one.
struct Decay : VectorProblem<3> {
  VectorOf<3> truth;
  double unit = 1.0;
  std::array<double, 20> measured{};

  Decay(const VectorOf<3>& t, double noise, std::mt19937_64& random) : truth(t) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (std::size_t i = 0; i < measured.size(); ++i) measured[i] = value(truth, time(i)) + noise * uniform(random);
  }
  static double time(std::size_t i) { return 0.2 * static_cast<double>(i); }
  double value(const VectorOf<3>& x, double t) const { return x[0] * std::exp(-unit * x[1] * t) + x[2]; }
  NormalEquations<3> linearise(const VectorOf<3>& x) const {
    NormalEquations<3> normal;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const double t = time(i), fall = std::exp(-unit * x[1] * t);
      normal.add({fall, -unit * t * x[0] * fall, 1.0}, value(x, t) - measured[i]);
    }
    return normal;
  }
};

/// log x = log 2: Newton's step from far above leads below zero, where the logarithm is not a number.
struct Logarithm : VectorProblem<1> {
  NormalEquations<1> linearise(const VectorOf<1>& x) const {
    NormalEquations<1> normal;
    normal.add(VectorOf<1>(1.0 / x[0]), std::log(x[0]) - std::log(2.0));
    return normal;
  }
};

/// Of three unknowns only the sum of the first two is observable; with kEnds such an end is requested.
template <bool kEnds>
struct SumOnly : VectorProblem<3> {
  static constexpr bool kEndsWhereSingular = kEnds;
  NormalEquations<3> linearise(const VectorOf<3>& x) const {
    NormalEquations<3> normal;
    const double sum = x[0] + x[1];
    normal.add({3.0 * sum * sum, 3.0 * sum * sum, 0.0}, sum * sum * sum - 27.0);
    return normal;
  }
};

}  // namespace pharos::optimize
