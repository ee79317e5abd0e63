// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/refine_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pharos::ellipse {
namespace {

constexpr int kIterations = 10;
// A tenth of what the best fits are uncertain by.
constexpr double kConverged_px = 2e-3;
constexpr double kTukey = 4.685;  // 95 % efficiency on normal noise
constexpr double kMedianToSigma = 1.4826;
// Lower limit of an edge's sigma, even if few points agree by chance.
constexpr double kMinSigma_px = 0.02;
// The shift sigma^2 / 2r at a tip whose radius of curvature is near sigma: s / sqrt(1 + (s / 0.435 sigma)^2) with s of
// the line above, within 0.004 sigma of the blurred tip of a parabola up to a curvature of 1 / sigma.
constexpr double kMaxShift = 0.435;
// Where the contour's other side is within the blur both sides push each other outwards: for a line of half-width
// b = beta sigma by 2 beta exp(-2 beta^2) sigma, for a disc by 1.2 exp(-beta^2) sigma; in between by q = b/a. Of
// ellipses blurred numerically: within 0.04 sigma from beta = 1.1, within 0.01 from 1.6.
constexpr double kBetaOfNoPush = 3.0;
constexpr double kThetaVariance = std::numbers::pi * std::numbers::pi / 12.0;

struct Turned {
  double cos = 1.0, sin = 0.0, cos2 = 1.0, sin2 = 0.0;
  explicit Turned(double theta) : cos(std::cos(theta)), sin(std::sin(theta)) {
    cos2 = cos * cos - sin * sin;
    sin2 = 2.0 * sin * cos;
  }
};

// Signed distances of points from the blurred contour's edge, and the terms of their derivatives. Columns, so that
// compilers take roots and divisions two at a time.
using Column = std::array<double, kMaxFitPoints>;
struct Distances {
  Column x, y;        // in the ellipse's axes
  Column fx, fy;      // slope of f = (x/a)^2 + (y/b)^2 - 1
  Column per_length;  // 1 / |slope|
  Column value;
};

// By how much the blurred flanks of a narrow ellipse push the contour outwards at the ends of its axes.
struct Push {
  double at_a_px = 0.0, at_b_px = 0.0;
};

Push push_of(const Ellipse& e) {
  const double sigma = std::sqrt(kFlankVariance_px2), beta = e.b_px / sigma, q = e.b_px / e.a_px;
  if (beta > kBetaOfNoPush) return {};
  const double fall = std::exp(-beta * beta);
  const double of_disc = 1.2 * fall, of_line = 2.0 * beta * fall * fall;
  return {sigma * q * q * of_disc, sigma * (of_line + q * q * q * (of_disc - of_line))};
}

class FittedContour {
 public:
  explicit FittedContour(const Ellipse& e)
      : e_(e), turned_(e.theta_rad), ka_(1.0 / (e.a_px * e.a_px)), kb_(1.0 / (e.b_px * e.b_px)), push_(push_of(e)) {}

  void measure(std::span<const PointF> points, Distances& d) const {
    const double cx = e_.cx_px, cy = e_.cy_px, cosine = turned_.cos, sine = turned_.sin, ka = ka_, kb = kb_;
    const double at_a = 0.5 * push_.at_a_px, at_b = 0.5 * push_.at_b_px;
    constexpr double kPerMaxShift = 1.0 / (kMaxShift * kMaxShift * kBlurVariance_px2);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double u = static_cast<double>(points[k].u) - cx, v = static_cast<double>(points[k].v) - cy;
      const double x = cosine * u + sine * v, y = cosine * v - sine * u;
      const double fx = 2.0 * x * ka, fy = 2.0 * y * kb;
      const double per_length = 1.0 / std::max(std::sqrt(fx * fx + fy * fy), 1e-9);
      const double curvature = 8.0 * per_length * per_length * per_length * ka * kb;
      d.x[k] = x;
      d.y[k] = y;
      d.fx[k] = fx;
      d.fy[k] = fy;
      d.per_length[k] = per_length;
      const double shift = 0.5 * kBlurVariance_px2 * curvature;
      const double inwards = shift / std::sqrt(1.0 + shift * shift * kPerMaxShift);
      d.value[k] = (0.5 * (x * fx + y * fy) - 1.0) * per_length + inwards - (at_a * x * fx + at_b * y * fy);
    }
  }
  // Of a point's distance by (cx, cy, m, e1, e2), m = (a+b)/2, (e1, e2) = (a-b)/2 (cos, sin)(2 theta).
  Vector5 slope(const Distances& d, std::size_t k) const {
    const double fx = d.fx[k], fy = d.fy[k];
    const double fa = -fx * d.x[k] / e_.a_px, fb = -fy * d.y[k] / e_.b_px;
    // Derivative by theta over (a - b): finite at the circle.
    const double ft = -2.0 * d.x[k] * d.y[k] * (e_.a_px + e_.b_px) * ka_ * kb_;
    Vector5 slope;
    slope << -(fx * turned_.cos - fy * turned_.sin), -(fx * turned_.sin + fy * turned_.cos), fa + fb,
        turned_.cos2 * (fa - fb) - turned_.sin2 * ft, turned_.sin2 * (fa - fb) + turned_.cos2 * ft;
    return slope * d.per_length[k];
  }
  const Turned& turned() const { return turned_; }

 private:
  const Ellipse& e_;
  Turned turned_;
  double ka_, kb_;
  Push push_;
};

std::optional<Ellipse> moved(const Ellipse& e, const Turned& turned, const Vector5& step) {
  const double mean = 0.5 * (e.a_px + e.b_px) + step[2], half = 0.5 * (e.a_px - e.b_px);
  const double e1 = half * turned.cos2 + step[3], e2 = half * turned.sin2 + step[4];
  const double difference = std::hypot(e1, e2);
  if (!(difference < mean)) return std::nullopt;
  return normalised(
      {e.cx_px + step[0], e.cy_px + step[1], mean + difference, mean - difference, 0.5 * std::atan2(e2, e1)});
}

double scatter_of(const Column& distances, std::size_t count) {
  std::array<float, kMaxFitPoints> sizes;
  for (std::size_t k = 0; k < count; ++k) sizes[k] = static_cast<float>(std::abs(distances[k]));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sizes.begin(), middle, sizes.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(kMinSigma_px, kMedianToSigma * static_cast<double>(*middle));
}

struct Normal {
  Matrix5 matrix = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double sigma = 0.0;
  double squares = 0.0;  // of the distances
};

// Lower triangles only.
Normal normal_equations(const FittedContour& contour, std::span<const PointF> points) {
  Distances distances;
  contour.measure(points, distances);
  Normal normal;
  normal.sigma = scatter_of(distances.value, points.size());
  const double per_width = 1.0 / (kTukey * normal.sigma);
  for (std::size_t k = 0; k < points.size(); ++k) {
    normal.squares += distances.value[k] * distances.value[k];
    const double ratio = distances.value[k] * per_width;
    if (std::abs(ratio) >= 1.0) continue;
    const double weight = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    const Vector5 slope = contour.slope(distances, k);
    const Vector5 weighted = weight * slope;
    for (int column = 0; column < 5; ++column) {
      for (int row = column; row < 5; ++row) normal.matrix(row, column) += weighted[row] * slope[column];
    }
    normal.gradient += weighted * distances.value[k];
  }
  return normal;
}

// From (cx, cy, m, e1, e2) to (cx, cy, a, b, theta); near the circle theta is undefined.
Matrix5 in_axes(const Matrix5& covariance, const Ellipse& e, const Turned& turned) {
  const double half = std::max(0.5 * (e.a_px - e.b_px), 1e-6);
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = change(1, 1) = 1.0;
  change.row(2) << 0.0, 0.0, 1.0, turned.cos2, turned.sin2;
  change.row(3) << 0.0, 0.0, 1.0, -turned.cos2, -turned.sin2;
  change.row(4) << 0.0, 0.0, 0.0, -turned.sin2 / (2.0 * half), turned.cos2 / (2.0 * half);
  Matrix5 out = change * covariance * change.transpose();
  const double of_a = 0.5 * kBlurSpread_px2 * e.a_px / (e.b_px * e.b_px);
  const double of_b = 0.5 * kBlurSpread_px2 * e.b_px / (e.a_px * e.a_px);
  out(2, 2) += of_a * of_a;
  out(3, 3) += of_b * of_b;
  out(2, 3) += of_a * of_b;
  out(3, 2) += of_a * of_b;
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
    const FittedContour contour(fit.ellipse);
    const Normal normal = normal_equations(contour, points);
    const Eigen::LDLT<Matrix5, Eigen::Lower> solver(normal.matrix);
    if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 1e-12 * normal.matrix.trace()) {
      return std::nullopt;
    }
    const Vector5 step = -solver.solve(normal.gradient);
    const std::optional<Ellipse> next = moved(fit.ellipse, contour.turned(), step);
    if (!next) return std::nullopt;
    const bool done = k + 1 == kIterations || step.cwiseAbs().maxCoeff() < kConverged_px;
    if (done) {
      fit.sigma_px = normal.sigma;
      fit.rms_px = std::sqrt(normal.squares / static_cast<double>(points.size()));
      // Column by column: Eigen solves for a matrix by a kernel that keeps the caches' sizes in a static.
      Matrix5 inverse;
      for (int i = 0; i < 5; ++i) inverse.col(i) = solver.solve(Vector5::Unit(i));
      const Matrix5 covariance = normal.sigma * normal.sigma / independent * inverse;
      fit.covariance = in_axes(covariance, fit.ellipse, contour.turned());
    }
    fit.ellipse = *next;
    if (done) break;
  }
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

}  // namespace pharos::ellipse
