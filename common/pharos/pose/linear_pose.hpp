// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "pharos/geometry/packed_symmetric.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::pose {

/// Eigenvector of the smallest eigenvalue of a positive semidefinite matrix, by inverse iteration from a start that is
/// not orthogonal to any axis-aligned structure.
template <std::size_t N>
std::array<double, N> smallest_eigenvector(PackedSymmetric<N> matrix) {
  constexpr int kIterations = 12;
  constexpr double kShift = 1e-12;  // of the trace: keeps an exactly singular matrix factorable
  double trace = 0.0;
  for (std::size_t i = 0; i < N; ++i) trace += matrix(i, i);
  for (std::size_t i = 0; i < N; ++i) matrix(i, i) += kShift * trace;
  const Factorisation<N> factor(matrix);
  std::array<double, N> x;
  for (std::size_t i = 0; i < N; ++i) x[i] = 1.0 + 0.1 * static_cast<double>(i);
  for (int k = 0; k < kIterations; ++k) {
    x = factor.solve(x);
    double square = 0.0;
    for (const double v : x) square += v * v;
    const double scale = 1.0 / std::sqrt(square);
    for (double& v : x) v *= scale;
  }
  return x;
}

/// Rotation nearest to a matrix of positive determinant: Newton's iteration of the polar decomposition (Higham 1986).
inline Matrix3 polar_rotation(const Matrix3& matrix) {
  constexpr int kIterations = 12;
  Matrix3 R = matrix / std::cbrt(matrix.determinant());
  for (int k = 0; k < kIterations; ++k) {
    Matrix3 cofactors;
    for (int c = 0; c < 3; ++c) cofactors.col(c) = R.col((c + 1) % 3).cross(R.col((c + 2) % 3));
    R = 0.5 * (R + cofactors / R.col(0).dot(cofactors.col(0)));
  }
  return R;
}

}  // namespace pharos::pose
