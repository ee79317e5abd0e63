// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/mounting_covariance.hpp"

#include <cmath>

#include "host/linear/dense.hpp"

namespace pharos::host {
namespace {

// Rounding error of a calibration's inverse; an eigenvalue below is a sign that was lost or a typing error.
constexpr double kMinEigenvalue = -1e-6;
constexpr double kSymmetry = 1e-6;  // of two elements, relative to both sigmas

std::string element(Eigen::Index row, Eigen::Index column) {
  return "row " + std::to_string(row + 1) + ", column " + std::to_string(column + 1);
}

template <int N>
std::optional<std::string> error_of(const Eigen::Matrix<double, N, N>& covariance, bool zero_allowed) {
  if (!covariance.allFinite()) return "holds a number that is not finite";
  Eigen::Matrix<double, N, 1> inverse_sigma;
  for (Eigen::Index i = 0; i < N; ++i) {
    const double variance = covariance(i, i);
    if (variance < 0.0 || (variance == 0.0 && !zero_allowed))
      return "the variance in " + element(i, i) + " is not positive";
    inverse_sigma[i] = variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0;
    if (variance == 0.0 && !(covariance.row(i).isZero(0.0) && covariance.col(i).isZero(0.0))) {
      return element(i, i) + " is zero, but not its row and column";
    }
    if (!std::isfinite(inverse_sigma[i])) return "the variance in " + element(i, i) + " is too small";
  }
  const Eigen::Matrix<double, N, N> scaled = inverse_sigma.asDiagonal() * covariance * inverse_sigma.asDiagonal();
  if (!scaled.allFinite()) return "its elements are too large for its variances";
  for (Eigen::Index i = 0; i < N; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!(std::abs(scaled(i, j) - scaled(j, i)) <= kSymmetry)) return "is not symmetric in " + element(i, j);
      if (!(std::abs(scaled(i, j)) <= 1.0 - kMinEigenvalue))
        return "the correlation in " + element(i, j) + " is above 1";
    }
  }
  if (!(dense_eigen(scaled).values[0] >= kMinEigenvalue)) return "is no covariance: it has a negative eigenvalue";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> covariance_error(const Matrix6& covariance, bool zero_allowed) {
  return error_of<6>(covariance, zero_allowed);
}

std::optional<std::string> joint_covariance_error(const SourceMounting& source) {
  if (!source.T_target_feature) {
    if (!source.cross_covariance.isZero(0.0)) return "must be absent where T_target_feature is unknown";
    return std::nullopt;
  }
  Eigen::Matrix<double, 12, 12> joint;
  joint << source.T_vehicle_sensor.covariance, source.cross_covariance, source.cross_covariance.transpose(),
      source.T_target_feature->covariance;
  return error_of<12>(joint, true);
}

}  // namespace pharos::host
