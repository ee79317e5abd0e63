// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/sweep_information.hpp"

#include <cmath>

namespace pharos::motion {
namespace {

// A pivot below this fraction of its diagonal is rounding, not information.
constexpr double kNoPivot = 1e-9;

}  // namespace

void InformationSums::add(const Vector6& jacobian, double residual_rad, double weight) {
  const Vector6 weighted = weight * jacobian;
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) square_(i, j) += weighted[i] * jacobian[j];
  }
  by_residual_ += weighted * residual_rad;
  sum_ += weighted;
  weight_ += weight;
  residual_sum_ += weight * residual_rad;
  residual_square_ += weight * residual_rad * residual_rad;
  ++hits_;
}

SweepInformation InformationSums::close(double common_variance) const {
  SweepInformation out;
  out.hits = hits_;
  const double fraction = common_variance / (1.0 + common_variance * weight_);
  Matrix6 a;
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) a(i, j) = square_(i, j) - fraction * sum_[i] * sum_[j];
  }
  const Vector6 right = by_residual_ - fraction * residual_sum_ * sum_;
  double explained = 0.0;
  // Cholesky's factor of a semidefinite matrix, and forward substitution with it.
  for (int j = 0; j < 6; ++j) {
    double pivot = a(j, j);
    double value = right[j];
    for (int k = 0; k < j; ++k) {
      pivot -= out.factor(j, k) * out.factor(j, k);
      value -= out.factor(j, k) * out.whitened[k];
    }
    if (!(pivot > kNoPivot * square_(j, j)) || !(pivot > 0.0)) continue;
    const double root = std::sqrt(pivot);
    out.factor(j, j) = root;
    out.whitened[j] = value / root;
    explained += out.whitened[j] * out.whitened[j];
    ++out.rank;
    for (int i = j + 1; i < 6; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= out.factor(i, k) * out.factor(j, k);
      out.factor(i, j) = sum / root;
    }
  }
  const double total = residual_square_ - fraction * residual_sum_ * residual_sum_;
  out.residual_chi2 = total > explained ? total - explained : 0.0;
  return out;
}

}  // namespace pharos::motion
