// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "pharos/geometry/types.hpp"

namespace pharos {

/// Inverse of a symmetric positive definite matrix, by its Cholesky factor; empty for others. Plain loops: Eigen's own
/// unrolls to seconds of compile time at these sizes.
template <int N>
std::optional<Eigen::Matrix<double, N, N>> positive_inverse(const Eigen::Matrix<double, N, N>& matrix) {
  Eigen::Matrix<double, N, N> lower;  // L of L L^T, then its inverse
  for (int j = 0; j < N; ++j) {
    for (int i = j; i < N; ++i) {
      double sum = matrix(i, j);
      for (int k = 0; k < j; ++k) sum -= lower(i, k) * lower(j, k);
      if (i > j) {
        lower(i, j) = sum / lower(j, j);
      } else if (sum > 1e-14 * matrix(j, j)) {  // rounding error of a singular one
        lower(j, j) = std::sqrt(sum);
      } else {
        return std::nullopt;
      }
    }
  }
  for (int j = 0; j < N; ++j) {
    lower(j, j) = 1.0 / lower(j, j);
    for (int i = j + 1; i < N; ++i) {
      double sum = 0.0;
      for (int k = j; k < i; ++k) sum -= lower(i, k) * lower(k, j);
      lower(i, j) = sum / lower(i, i);
    }
  }
  Eigen::Matrix<double, N, N> inverse;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (int k = i; k < N; ++k) sum += lower(k, i) * lower(k, j);
      inverse(i, j) = inverse(j, i) = sum;
    }
  }
  return inverse;
}

/// Adds weight * row * row^T to a symmetric matrix.
template <int N>
void add_outer(Eigen::Matrix<double, N, N>& matrix, const Eigen::Matrix<double, N, 1>& row, double weight) {
  for (int i = 0; i < N; ++i) {
    const double scaled = weight * row[i];
    for (int j = 0; j < N; ++j) matrix(i, j) += scaled * row[j];
  }
}

}  // namespace pharos
