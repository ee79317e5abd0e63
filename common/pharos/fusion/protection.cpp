// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/protection.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "pharos/fusion/chi_squared.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::fusion {
namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kMinProbability = 1e-30;

double sigmas_of(double probability) {
  if (probability >= 1.0) return 0.0;
  return std::sqrt(chi_squared_bound(std::max(probability, kMinProbability), 3));
}

double largest(const Matrix3& covariance) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
}

}  // namespace

ProtectionFactors protection_factors(const Settings& settings) {
  const IntegritySettings& integrity = settings.integrity;
  const double looks = kSecondsPerHour / integrity.correlation_time_s;
  ProtectionFactors factors;
  factors.fault_free = sigmas_of(0.5 * integrity.risk_per_hour / looks);
  const double each = 0.5 * integrity.risk_per_hour / static_cast<double>(settings.sources.size());
  for (std::size_t s = 0; s < settings.sources.size(); ++s) {
    double faults = 0.0;
    for (const double rate : settings.sources[s].faults_per_hour) faults += rate;
    factors.without[s] = faults > 0.0 ? sigmas_of(each / (faults * looks)) : 0.0;
  }
  return factors;
}

LargestSigma largest_sigma(const Matrix6& P) {
  return {largest(P.topLeftCorner<3, 3>()), largest(P.bottomRightCorner<3, 3>())};
}

void widen(ProtectionLevel& level, const Filter& main, const Filter& other, double factor) {
  const Vector6 apart = pose_difference(main.mean().pose, other.mean().pose);
  const LargestSigma sigma = largest_sigma(other.pose_covariance());
  level.rotation_rad = std::max(level.rotation_rad, apart.head<3>().norm() + factor * sigma.rotation_rad);
  level.position_m = std::max(level.position_m, apart.tail<3>().norm() + factor * sigma.position_m);
}

// In the axes in which P_i is one and P is diagonal.
double separation_chi2(const Vector3& d, const Matrix3& P_i, const Matrix3& P) {
  const SymmetricEigen<3> smaller = symmetric_eigen<3>(P_i);
  if (!(smaller.values[0] > 0.0)) return 0.0;
  const Matrix3 whitening = smaller.vectors * smaller.values.cwiseSqrt().cwiseInverse().asDiagonal();
  const SymmetricEigen<3> all = symmetric_eigen<3>(Matrix3(whitening.transpose() * P * whitening));
  const Vector3 along = all.vectors.transpose() * (whitening.transpose() * d);
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += along[i] * along[i] / (std::max(1.0 - all.values[i], 0.0) + kSeparationSlack);
  return sum;
}

}  // namespace pharos::fusion
