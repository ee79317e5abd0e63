// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/gravity.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::size_t kMinPieces = 3, kMinSamples = 10;  // the latter of a piece
constexpr double kEnd_s = 0.08;                          // at a piece's ends accelerations are not known well
constexpr int kRounds = 30;
// Of an accelerometer and how it is mounted against the sensors, 1 sigma.
constexpr double kBias_m_s2 = 0.4;

// Means over a piece of motion: of R f - a, and of R.
struct PieceMean {
  Vector3 force = Vector3::Zero();
  Matrix3 attitude = Matrix3::Zero();
};

std::vector<PieceMean> means_of(const std::vector<BodySpline>& motion, const std::vector<Acceleration>& samples) {
  std::vector<PieceMean> means;
  std::size_t i = 0;
  for (const BodySpline& piece : motion) {
    PieceMean sum;
    std::size_t count = 0;
    const double begin_s = piece.begin_s() + kEnd_s, end_s = piece.end_s() - kEnd_s;
    while (i < samples.size() && samples[i].time_s < begin_s) ++i;
    for (; i < samples.size() && samples[i].time_s <= end_s; ++i, ++count) {
      const double at_s = samples[i].time_s;
      const Matrix3 R = piece.pose(at_s).R;
      sum.force += R * samples[i].f_m_s2 - piece.acceleration_m_s2(at_s);
      sum.attitude += R;
    }
    if (count < kMinSamples) continue;
    const double n = static_cast<double>(count);
    means.push_back({sum.force / n, sum.attitude / n});
  }
  return means;
}

double middle_of(std::vector<double> values) {
  const auto half = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

}  // namespace

Up up_of(const std::vector<BodySpline>& motion, const std::vector<Acceleration>& samples) {
  const std::vector<PieceMean> means = means_of(motion, samples);
  Up up;
  if (means.size() < kMinPieces) return up;
  Vector3 gravity = Vector3::Zero(), bias = Vector3::Zero();
  Matrix6 covariance = Matrix6::Zero();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> left;
    for (const PieceMean& m : means) left.push_back((m.force - gravity - m.attitude * bias).norm());
    // The median of the norm of three equal sigmas is 1.54 of them.
    const double sigma = std::max(1e-6, middle_of(left) / 1.54);
    Matrix6 N = Matrix6::Zero();
    N.bottomRightCorner<3, 3>().diagonal().setConstant(sigma * sigma / (kBias_m_s2 * kBias_m_s2));
    Vector6 b = Vector6::Zero();
    for (std::size_t k = 0; k < means.size(); ++k) {
      Eigen::Matrix<double, 3, 6> A;
      A << Matrix3::Identity(), means[k].attitude;
      const double weight = std::min(1.0, 2.0 * sigma / std::max(1e-9, left[k]));  // Huber
      N += weight * A.transpose() * A;
      b += weight * A.transpose() * means[k].force;
    }
    const auto inverse = positive_inverse<6>(N);
    if (!inverse) return up;
    const Vector6 x = *inverse * b;
    gravity = x.head<3>();
    bias = x.tail<3>();
    covariance = sigma * sigma * *inverse;
  }
  if (!(gravity.norm() > 0.0)) return up;
  up.direction = gravity.normalized();
  const Matrix3 across = Matrix3::Identity() - up.direction * up.direction.transpose();
  up.sigma_rad = std::sqrt((across * covariance.topLeftCorner<3, 3>() * across).trace() / 2.0) / gravity.norm();
  return up;
}

}  // namespace pharos::calibrate
