// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pharos::pose {

/// Coefficients of a polynomial, constant first.
template <std::size_t Degree>
using Polynomial = std::array<double, Degree + 1>;

template <std::size_t Degree>
constexpr double value_at(const Polynomial<Degree>& p, double x) {
  double sum = p[Degree];
  for (std::size_t k = Degree; k-- > 0;) sum = sum * x + p[k];
  return sum;
}

template <std::size_t Degree>
constexpr Polynomial<Degree - 1> derivative(const Polynomial<Degree>& p) {
  Polynomial<Degree - 1> d{};
  for (std::size_t k = 0; k < Degree; ++k) d[k] = p[k + 1] * static_cast<double>(k + 1);
  return d;
}

/// Real roots inside an interval, ascending.
template <std::size_t Degree>
struct RealRoots {
  std::array<double, Degree> root{};
  std::size_t count = 0;
};

/// Root between low and high, where the sign changes, by bisection: exact to the last bits, and always converges.
template <std::size_t Degree>
double bisected(const Polynomial<Degree>& p, double low, double high) {
  constexpr int kHalvings = 60;
  const bool rises = value_at<Degree>(p, low) < 0.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    ((value_at<Degree>(p, middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Roots of odd multiplicity in [low, high]: between neighbouring roots of the derivative there is at most one.
template <std::size_t Degree>
RealRoots<Degree> real_roots(const Polynomial<Degree>& p, double low, double high) {
  RealRoots<Degree> roots;
  if constexpr (Degree == 1) {
    const double x = -p[0] / p[1];
    if (x >= low && x <= high) roots.root[roots.count++] = x;
  } else {
    const RealRoots<Degree - 1> turns = real_roots<Degree - 1>(derivative<Degree>(p), low, high);
    double left = low;
    for (std::size_t k = 0; k <= turns.count; ++k) {
      const double right = k < turns.count ? turns.root[k] : high;
      if ((value_at<Degree>(p, left) < 0.0) != (value_at<Degree>(p, right) < 0.0)) {
        roots.root[roots.count++] = bisected<Degree>(p, left, right);
      }
      left = right;
    }
  }
  return roots;
}

}  // namespace pharos::pose
