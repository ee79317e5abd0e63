// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace pharos {

/// Symmetric N x N matrix, lower triangle by rows: normal equations are summed and solved in it.
template <std::size_t N, class Number = double>
struct PackedSymmetric {
  std::array<Number, N*(N + 1) / 2> lower{};

  static constexpr std::size_t index(std::size_t row, std::size_t column) {
    return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
  }
  constexpr Number& operator()(std::size_t row, std::size_t column) { return lower[index(row, column)]; }
  constexpr Number operator()(std::size_t row, std::size_t column) const { return lower[index(row, column)]; }
};

/// L D L^T of a positive definite matrix, without square roots. Cost at N = 6: 70 multiplications, 6 divisions.
template <std::size_t N>
class Factorisation {
 public:
  explicit Factorisation(const PackedSymmetric<N>& a) {
    for (std::size_t j = 0; j < N; ++j) {
      std::array<double, N> scaled;
      const double diagonal = a(j, j);
      double pivot = diagonal;
      for (std::size_t k = 0; k < j; ++k) {
        scaled[k] = l_(j, k) * pivot_[k];
        pivot -= l_(j, k) * scaled[k];
      }
      pivot_[j] = pivot;
      if (!(pivot > diagonal * smallest_ratio_)) smallest_ratio_ = diagonal > 0.0 ? pivot / diagonal : 0.0;
      const double inverse = pivot > 0.0 ? 1.0 / pivot : 0.0;
      inverse_pivot_[j] = inverse;
      for (std::size_t i = j + 1; i < N; ++i) {
        double sum = a(i, j);
        for (std::size_t k = 0; k < j; ++k) sum -= l_(i, k) * scaled[k];
        l_(i, j) = sum * inverse;
      }
    }
  }

  /// Smallest pivot over its diagonal element, at most 1: the part of the least determined unknown that is independent
  /// of the ones before it. Zero or less where the matrix is singular.
  double smallest_ratio() const { return smallest_ratio_; }

  std::array<double, N> solve(const std::array<double, N>& right) const {
    std::array<double, N> x = right;
    for (std::size_t i = 1; i < N; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= l_(i, k) * x[k];
    }
    for (std::size_t i = 0; i < N; ++i) x[i] *= inverse_pivot_[i];
    for (std::size_t i = N - 1; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) x[i] -= l_(k, i) * x[k];
    }
    return x;
  }

 private:
  PackedSymmetric<N> l_;
  std::array<double, N> pivot_;
  std::array<double, N> inverse_pivot_;
  double smallest_ratio_ = 1.0;
};

}  // namespace pharos
