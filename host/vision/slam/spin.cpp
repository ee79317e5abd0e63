// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/spin.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "host/vision/slam/rotation_jacobian.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "pharos/optimize/descent.hpp"
#include "pharos/optimize/least_squares.hpp"

namespace pharos::slam {
namespace {

constexpr std::size_t kMinFrames = 10;
constexpr int kMaxIterations = 20;
// Convergence: decrease of the sum of squares over all attitudes in the last step, rad^2.
constexpr double kConverged = 1e-18;

struct Attitude {
  double time_s;
  Matrix3 R;
};

// A rotation at constant rate: exp(rate (t - mean_time)) R_mean.
struct Turn {
  Vector3 rate = Vector3::Zero();
  Matrix3 R_mean = Matrix3::Identity();
  double mean_time_s = 0.0;
};

Vector3 residual(const Turn& turn, const Attitude& attitude) {
  const Matrix3 predicted = rotation_exp(turn.rate * (attitude.time_s - turn.mean_time_s)) * turn.R_mean;
  return rotation_log(attitude.R * predicted.transpose());
}

// Unknowns: the rate (rad/s), then a rotation of R_mean from the left (rad).
struct TurnDescent : optimize::LeastSquares<6, Turn> {
  explicit TurnDescent(std::span<const Attitude> a) : attitudes(a) {}

  Normal linearise(const Turn& turn) const {
    Normal normal;
    for (const Attitude& attitude : attitudes) {
      const double t = attitude.time_s - turn.mean_time_s;
      const Vector3 phi = turn.rate * t, e = residual(turn, attitude);
      Eigen::Matrix<double, 3, 6> J;  // of the prediction
      J << t * left_jacobian(phi), rotation_exp(phi);
      normal.matrix += J.transpose() * J;
      normal.gradient -= J.transpose() * e;
      normal.cost += e.squaredNorm();
    }
    return normal;
  }
  Turn moved(const Turn& turn, const Vector6& delta) const {
    return {turn.rate + delta.head<3>(), rotation_exp(delta.tail<3>()) * turn.R_mean, turn.mean_time_s};
  }

  std::span<const Attitude> attitudes;
};
using Fit = optimize::Descent<TurnDescent>;

// Fit over these attitudes, starting from the last fit.
void refine(Fit& fit, std::span<const Attitude> attitudes) {
  Turn start = fit.state;
  double mean = 0.0;
  for (const Attitude& attitude : attitudes) mean += attitude.time_s / static_cast<double>(attitudes.size());
  start.R_mean = rotation_exp(start.rate * (mean - start.mean_time_s)) * start.R_mean;
  start.mean_time_s = mean;
  optimize::descend(TurnDescent(attitudes), start, {kMaxIterations, kConverged}, fit);
}

// Correlation length in residuals: the sum of the correlations up to their first zero, in both directions.
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
  const double largest = symmetric_eigen<3>(across * covariance * across).values[2];
  return std::sqrt(std::max(0.0, largest)) / rate();
}

std::optional<Spin> fit_spin(const std::vector<TrackedFrame>& frames) {
  std::vector<Attitude> attitudes;
  for (const TrackedFrame& frame : frames) {
    if (frame.placed) attitudes.push_back({frame.time_s, frame.placed->pose.R});
  }
  if (attitudes.size() < kMinFrames) return std::nullopt;
  Fit fit;
  const double first_s = attitudes[kMinFrames - 1].time_s - attitudes[0].time_s;
  fit.state.rate = rotation_log(attitudes[kMinFrames - 1].R * attitudes[0].R.transpose()) / first_s;
  fit.state.R_mean = attitudes[0].R;
  fit.state.mean_time_s = attitudes[0].time_s;
  // Increasing lengths, so that the prediction for the next is never wrong by half a turn.
  for (std::size_t count = kMinFrames; count < attitudes.size(); count *= 2) {
    refine(fit, std::span(attitudes).first(count));
  }
  refine(fit, attitudes);
  const Turn& turn = fit.state;
  std::vector<Vector3> residuals;
  double sum = 0.0;
  for (const Attitude& attitude : attitudes) {
    residuals.push_back(residual(turn, attitude));
    sum += residuals.back().squaredNorm();
  }
  const double variance = sum / (3.0 * static_cast<double>(residuals.size()) - 6.0);
  Spin spin;
  spin.rate_rad_s = turn.rate;
  spin.covariance = (fit.normal.matrix.inverse() * (variance * correlation_length(residuals))).topLeftCorner<3, 3>();
  spin.residual_rms_rad = std::sqrt(sum / static_cast<double>(residuals.size()));
  spin.turned_rad = turn.rate.norm() * (attitudes.back().time_s - attitudes.front().time_s);
  spin.frames = static_cast<int>(residuals.size());
  return spin;
}

Spin steady_spin(const Vector3& rate_rad_s, const Spin& fit) {
  Spin out = fit;
  const Vector3 off = rate_rad_s - fit.rate_rad_s;
  out.rate_rad_s = rate_rad_s;
  out.covariance += off * off.transpose();
  if (fit.rate() > 0.0) out.turned_rad *= rate_rad_s.norm() / fit.rate();
  return out;
}

}  // namespace pharos::slam
