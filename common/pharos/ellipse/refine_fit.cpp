// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/refine_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pharos::ellipse {
namespace {

constexpr int kIterations = 12;
constexpr double kConverged_px = 1e-4;
constexpr double kTukey = 4.685;  // 95 % efficiency on normal noise
constexpr double kSigmaOfMedian = 1.4826;
// No edge is known better than this, however few points agree by chance.
constexpr double kLeastSigma_px = 0.02;
constexpr double kThetaVariance = std::numbers::pi * std::numbers::pi / 12.0;

// Signed distance of a point and its derivative by (cx, cy, m, e1, e2), m = (a+b)/2, e = (a-b)/2 (cos, sin)(2 theta).
struct Row {
  double distance = 0.0;
  Vector5 slope = Vector5::Zero();
};

struct Turned {
  double cos = 1.0, sin = 0.0, cos2 = 1.0, sin2 = 0.0;
  explicit Turned(double theta)
      : cos(std::cos(theta)), sin(std::sin(theta)), cos2(std::cos(2.0 * theta)), sin2(std::sin(2.0 * theta)) {}
};

Row row_of(const Ellipse& e, const Turned& turned, PointF point) {
  const double u = static_cast<double>(point.u) - e.cx_px, v = static_cast<double>(point.v) - e.cy_px;
  const double x = turned.cos * u + turned.sin * v, y = turned.cos * v - turned.sin * u;
  const double ka = 1.0 / (e.a_px * e.a_px), kb = 1.0 / (e.b_px * e.b_px);
  const double f = x * x * ka + y * y * kb - 1.0;
  const double fx = 2.0 * x * ka, fy = 2.0 * y * kb;
  const double length = std::max(std::hypot(fx, fy), 1e-9);
  const double fa = -fx * x / e.a_px, fb = -fy * y / e.b_px;
  // Derivative by theta over (a - b): finite at the circle.
  const double ft = -2.0 * x * y * (e.a_px + e.b_px) * ka * kb;
  Row row;
  row.distance = f / length;
  row.slope << -(fx * turned.cos - fy * turned.sin), -(fx * turned.sin + fy * turned.cos), fa + fb,
      turned.cos2 * (fa - fb) - turned.sin2 * ft, turned.sin2 * (fa - fb) + turned.cos2 * ft;
  row.slope /= length;
  return row;
}

std::optional<Ellipse> moved(const Ellipse& e, const Turned& turned, const Vector5& step) {
  const double mean = 0.5 * (e.a_px + e.b_px) + step[2], half = 0.5 * (e.a_px - e.b_px);
  const double e1 = half * turned.cos2 + step[3], e2 = half * turned.sin2 + step[4];
  const double difference = std::hypot(e1, e2);
  if (!(difference < mean)) return std::nullopt;
  return normalised(
      {e.cx_px + step[0], e.cy_px + step[1], mean + difference, mean - difference, 0.5 * std::atan2(e2, e1)});
}

using Distances = std::array<float, kMaxFitPoints>;

double scatter_of(Distances distances, std::size_t count) {
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(distances.begin(), middle, distances.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(kLeastSigma_px, kSigmaOfMedian * static_cast<double>(*middle));
}

struct Normal {
  Matrix5 matrix = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double sigma = 0.0;
};

Normal normal_equations(const Ellipse& e, const Turned& turned, std::span<const PointF> points) {
  Distances distances;
  for (std::size_t k = 0; k < points.size(); ++k) {
    distances[k] = static_cast<float>(std::abs(row_of(e, turned, points[k]).distance));
  }
  Normal normal;
  normal.sigma = scatter_of(distances, points.size());
  for (const PointF& point : points) {
    const Row row = row_of(e, turned, point);
    const double ratio = row.distance / (kTukey * normal.sigma);
    if (std::abs(ratio) >= 1.0) continue;
    const double weight = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    normal.matrix.noalias() += weight * row.slope * row.slope.transpose();
    normal.gradient.noalias() += weight * row.distance * row.slope;
  }
  return normal;
}

// From (cx, cy, m, e1, e2) to (cx, cy, a, b, theta); near the circle theta is given up.
Matrix5 in_axes(const Matrix5& covariance, const Ellipse& e, const Turned& turned) {
  const double half = std::max(0.5 * (e.a_px - e.b_px), 1e-6);
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = change(1, 1) = 1.0;
  change.row(2) << 0.0, 0.0, 1.0, turned.cos2, turned.sin2;
  change.row(3) << 0.0, 0.0, 1.0, -turned.cos2, -turned.sin2;
  change.row(4) << 0.0, 0.0, 0.0, -turned.sin2 / (2.0 * half), turned.cos2 / (2.0 * half);
  Matrix5 out = change * covariance * change.transpose();
  if (out(4, 4) > kThetaVariance) {
    out.row(4).setZero();
    out.col(4).setZero();
    out(4, 4) = kThetaVariance;
  }
  return out;
}

}  // namespace

std::optional<RefinedFit> refine_fit(const Ellipse& start, std::span<const PointF> points, double independent) {
  if (points.size() > kMaxFitPoints) points = points.first(kMaxFitPoints);
  if (points.size() <= 5) return std::nullopt;
  RefinedFit fit{start, Matrix5::Zero(), 0.0};
  for (int k = 0; k < kIterations; ++k) {
    const Turned turned(fit.ellipse.theta_rad);
    const Normal normal = normal_equations(fit.ellipse, turned, points);
    const Eigen::LDLT<Matrix5> solver(normal.matrix);
    if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 1e-12 * normal.matrix.trace()) {
      return std::nullopt;
    }
    const Vector5 step = -solver.solve(normal.gradient);
    const std::optional<Ellipse> next = moved(fit.ellipse, turned, step);
    if (!next) return std::nullopt;
    fit.sigma_px = normal.sigma;
    fit.covariance =
        in_axes(normal.sigma * normal.sigma / independent * solver.solve(Matrix5::Identity()), fit.ellipse, turned);
    fit.ellipse = *next;
    if (step.cwiseAbs().maxCoeff() < kConverged_px) break;
  }
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

}  // namespace pharos::ellipse
