// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/spin.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace pharos::slam {
namespace {

constexpr std::size_t kMinFrames = 10;
constexpr int kSteps = 8;

// d log(exp(phi + d) exp(-phi)) / d d.
Matrix3 left_jacobian(const Vector3& phi) {
  const double angle = phi.norm();
  const Matrix3 cross = skew(phi);
  if (angle < 1e-6) return Matrix3::Identity() + 0.5 * cross;
  return Matrix3::Identity() + (1.0 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

struct Attitude {
  double time_s;
  Matrix3 R;
};

struct Fit {
  Vector3 rate = Vector3::Zero();
  Matrix3 R_mean = Matrix3::Identity();
  Matrix6 H = Matrix6::Zero();
  double mean_time_s = 0.0;
};

Vector3 residual(const Fit& fit, const Attitude& attitude) {
  const Matrix3 predicted = rotation_exp(fit.rate * (attitude.time_s - fit.mean_time_s)) * fit.R_mean;
  return rotation_log(attitude.R * predicted.transpose());
}

// Gauss and Newton over the first `count` attitudes.
void refine(Fit& fit, const std::vector<Attitude>& attitudes, std::size_t count) {
  double mean = 0.0;
  for (std::size_t k = 0; k < count; ++k) mean += attitudes[k].time_s / static_cast<double>(count);
  fit.R_mean = rotation_exp(fit.rate * (mean - fit.mean_time_s)) * fit.R_mean;
  fit.mean_time_s = mean;
  for (int step = 0; step < kSteps; ++step) {
    fit.H.setZero();
    Vector6 g = Vector6::Zero();
    for (std::size_t k = 0; k < count; ++k) {
      const double t = attitudes[k].time_s - mean;
      const Vector3 phi = fit.rate * t;
      Eigen::Matrix<double, 3, 6> J;
      J << t * left_jacobian(phi), rotation_exp(phi);
      fit.H += J.transpose() * J;
      g += J.transpose() * residual(fit, attitudes[k]);
    }
    const Vector6 delta = fit.H.ldlt().solve(g);
    fit.rate += delta.head<3>();
    fit.R_mean = rotation_exp(delta.tail<3>()) * fit.R_mean;
  }
}

// How many neighbours one residual speaks for: the sum of the correlations up to their first zero, both ways.
double correlation_length(const std::vector<Vector3>& residuals) {
  double variance = 0.0;
  for (const Vector3& r : residuals) variance += r.squaredNorm();
  if (!(variance > 0.0)) return 1.0;
  double length = 1.0;
  for (std::size_t lag = 1; lag < residuals.size() / 2; ++lag) {
    double sum = 0.0;
    for (std::size_t k = lag; k < residuals.size(); ++k) sum += residuals[k].dot(residuals[k - lag]);
    if (sum <= 0.0) break;
    length += 2.0 * sum / variance;
  }
  return length;
}

}  // namespace

double Spin::sigma_rate_rad_s() const { return std::sqrt(std::max(0.0, axis().dot(covariance * axis()))); }

double Spin::sigma_axis_rad() const {
  const Matrix3 across = Matrix3::Identity() - axis() * axis().transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(across * covariance * across);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2])) / rate();
}

std::optional<Spin> fit_spin(const std::vector<TrackedFrame>& frames) {
  std::vector<Attitude> attitudes;
  for (const TrackedFrame& frame : frames) {
    if (frame.placed) attitudes.push_back({frame.time_s, frame.placed->pose.R});
  }
  if (attitudes.size() < kMinFrames) return std::nullopt;
  Fit fit;
  const double first_s = attitudes[kMinFrames - 1].time_s - attitudes[0].time_s;
  fit.rate = rotation_log(attitudes[kMinFrames - 1].R * attitudes[0].R.transpose()) / first_s;
  fit.R_mean = attitudes[0].R;
  fit.mean_time_s = attitudes[0].time_s;
  // Ever longer parts, so that what is predicted for the next is never half a turn off.
  for (std::size_t count = kMinFrames; count < attitudes.size(); count *= 2) refine(fit, attitudes, count);
  refine(fit, attitudes, attitudes.size());
  std::vector<Vector3> residuals;
  double sum = 0.0;
  for (const Attitude& attitude : attitudes) {
    residuals.push_back(residual(fit, attitude));
    sum += residuals.back().squaredNorm();
  }
  const double variance = sum / (3.0 * static_cast<double>(residuals.size()) - 6.0);
  Spin spin;
  spin.rate_rad_s = fit.rate;
  spin.covariance = (fit.H.inverse() * (variance * correlation_length(residuals))).topLeftCorner<3, 3>();
  spin.residual_rms_rad = std::sqrt(sum / static_cast<double>(residuals.size()));
  spin.turned_rad = fit.rate.norm() * (attitudes.back().time_s - attitudes.front().time_s);
  spin.frames = static_cast<int>(residuals.size());
  return spin;
}

}  // namespace pharos::slam
