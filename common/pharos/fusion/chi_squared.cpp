// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/chi_squared.hpp"

#include <cmath>
#include <numbers>

namespace pharos::fusion {

double chi_squared_tail(double x, int dof) {
  // Terms (x/2)^k / Gamma(k + 1) from k = 0 (even) or 1/2 (odd).
  const double half = 0.5 * x;
  const bool odd = dof % 2 != 0;
  double term = odd ? 2.0 * std::sqrt(half / std::numbers::pi) : 1.0;
  double sum = 0.0;
  for (int k = odd ? 1 : 0; k <= (odd ? dof / 2 : dof / 2 - 1); ++k) {
    sum += term;
    term *= half / (odd ? k + 0.5 : k + 1.0);
  }
  return (odd ? std::erfc(std::sqrt(half)) : 0.0) + std::exp(-half) * sum;
}

double chi_squared_bound(double probability, int dof) {
  double low = 0.0;
  double high = 1400.0;  // tail below 1e-300
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (chi_squared_tail(middle, dof) > probability ? low : high) = middle;
  }
  return high;
}

}  // namespace pharos::fusion
