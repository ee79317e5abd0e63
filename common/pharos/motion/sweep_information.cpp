// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/sweep_information.hpp"

#include <cmath>

#include "pharos/motion/unrolled.hpp"

namespace pharos::motion {
namespace {

// A pivot below this fraction of its diagonal is rounding, not information.
constexpr double kNoPivot = 1e-9;

Matrix3 lower_root(const Matrix3& covariance) {
  Matrix3 root = Matrix3::Zero();
  for (int j = 0; j < 3; ++j) {
    double pivot = covariance(j, j);
    for (int k = 0; k < j; ++k) pivot -= root(j, k) * root(j, k);
    if (!(pivot > kNoPivot * covariance(j, j))) continue;
    root(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 3; ++i) {
      double sum = covariance(i, j);
      for (int k = 0; k < j; ++k) sum -= root(i, k) * root(j, k);
      root(i, j) = sum / root(j, j);
    }
  }
  return root;
}

// Takes an unknown of prior variance one out of the sums (Schur complement); returns its pivot.
template <int n>
double eliminate_unit(Eigen::Matrix<double, n, n>& sums, int k) {
  const double pivot = 1.0 + sums(k, k);
  const Eigen::Matrix<double, n, 1> column = sums.col(k);
  sums -= ((1.0 / pivot) * column).lazyProduct(column.transpose());
  return pivot;
}

// Cholesky's factor of a semidefinite matrix, of which the lower triangle is given, and forward substitution with it.
// `diagonal`: of the sums before anything was taken out of them.
SweepInformation factored(const Matrix6& a, const Vector6& diagonal, const Vector6& right, double total, int hits) {
  SweepInformation out;
  out.hits = hits;
  double explained = 0.0;
  for (int j = 0; j < 6; ++j) {
    double pivot = a(j, j);
    double value = right[j];
    for (int k = 0; k < j; ++k) {
      pivot -= out.factor(j, k) * out.factor(j, k);
      value -= out.factor(j, k) * out.whitened[k];
    }
    if (!(pivot > kNoPivot * diagonal[j]) || !(pivot > 0.0)) continue;
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
  out.residual_chi2 = total > explained ? total - explained : 0.0;
  return out;
}

}  // namespace

[[gnu::flatten]] void InformationSums::add(const Vector6& jacobian, double residual_rad, double weight) {
  const Vector6 weighted = weight * jacobian;
  for_each_number<6>([&](auto number) {
    constexpr int j = number, rows = 6 - even(j);
    square_.col(j).tail<rows>() += weighted.tail<rows>() * jacobian[j];
  });
  by_residual_ += weighted * residual_rad;
  sum_ += weighted;
  weight_ += weight;
  residual_sum_ += weight * residual_rad;
  residual_square_ += weight * residual_rad * residual_rad;
  ++hits_;
}

SweepInformation InformationSums::close(double common_variance) const {
  const double fraction = common_variance / (1.0 + common_variance * weight_);
  Matrix6 a;
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) a(i, j) = square_(i, j) - fraction * sum_[i] * sum_[j];
  }
  const Vector6 right = by_residual_ - fraction * residual_sum_ * sum_;
  const double total = residual_square_ - fraction * residual_sum_ * residual_sum_;
  return factored(a, square_.diagonal(), right, total, hits_);
}

SharedSums::SharedSums(const Matrix3& place_covariance, double common_variance)
    : place_root_(lower_root(place_covariance)), common_root_(std::sqrt(common_variance)) {}

void SharedSums::add(const Vector6& jacobian, double residual_rad, double weight, const Vector3& place) {
  Eigen::Matrix<double, kAll, 1> row;
  row << jacobian, residual_rad, common_root_, place_root_.transpose().lazyProduct(place);
  sum_ += weight * row.lazyProduct(row.transpose());
  ++hits_;
}

SweepInformation SharedSums::close() const {
  Sums left = sum_;
  for (int k = kAll - 1; k >= kShared; --k) eliminate_unit(left, k);
  return factored(left.topLeftCorner<6, 6>(), sum_.diagonal().head<6>(), left.col(kResidual).head<6>(),
                  left(kResidual, kResidual), hits_);
}

double SharedSums::log_determinant() const {
  Sums left = sum_;
  eliminate_unit(left, kShared);
  double log = 0.0;
  for (int k = kPlaces; k < kAll; ++k) log += std::log(eliminate_unit(left, k));
  return log;
}

}  // namespace pharos::motion
