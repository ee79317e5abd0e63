// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/blurred_contour.hpp"

#include <algorithm>
#include <numbers>

namespace pharos::ellipse {
namespace {

// The shift sigma^2 / 2r at a tip whose radius of curvature is near sigma: s / sqrt(1 + (s / 0.435 sigma)^2) with s of
// the line above, within 0.004 sigma of the blurred tip of a parabola up to a curvature of 1 / sigma.
constexpr double kMaxShift = 0.435;
// Where the contour's other side is within the blur both sides push each other outwards: for a line of half-width
// b = beta sigma by 2 beta exp(-2 beta^2) sigma, for a disc by 1.2 exp(-beta^2) sigma; in between by q = b/a. Of
// ellipses blurred numerically: within 0.04 sigma from beta = 1.1, within 0.01 from 1.6.
constexpr double kBetaOfNoPush = 3.0;
constexpr double kThetaVariance = std::numbers::pi * std::numbers::pi / 12.0;

}  // namespace

BlurredContour::BlurredContour(const Ellipse& e)
    : ellipse_(e), turned_(e.theta_rad), ka_(1.0 / (e.a_px * e.a_px)), kb_(1.0 / (e.b_px * e.b_px)) {
  const double sigma = std::sqrt(kFlankVariance_px2), beta = e.b_px / sigma, q = e.b_px / e.a_px;
  if (beta > kBetaOfNoPush) return;
  const double fall = std::exp(-beta * beta);
  const double of_disc = 1.2 * fall, of_line = 2.0 * beta * fall * fall;
  push_at_a_px_ = sigma * q * q * of_disc;
  push_at_b_px_ = sigma * (of_line + q * q * q * (of_disc - of_line));
}

void BlurredContour::measure(std::span<const PointF> points, ContourDistances& d) const {
  const double cx = ellipse_.cx_px, cy = ellipse_.cy_px, cosine = turned_.cos, sine = turned_.sin, ka = ka_, kb = kb_;
  const double at_a = 0.5 * push_at_a_px_, at_b = 0.5 * push_at_b_px_;
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

Vector5 BlurredContour::slope(const ContourDistances& d, std::size_t k) const {
  const double fx = d.fx[k], fy = d.fy[k];
  const double fa = -fx * d.x[k] / ellipse_.a_px, fb = -fy * d.y[k] / ellipse_.b_px;
  // Derivative by theta over (a - b): finite at the circle.
  const double ft = -2.0 * d.x[k] * d.y[k] * (ellipse_.a_px + ellipse_.b_px) * ka_ * kb_;
  Vector5 slope;
  slope << -(fx * turned_.cos - fy * turned_.sin), -(fx * turned_.sin + fy * turned_.cos), fa + fb,
      turned_.cos2 * (fa - fb) - turned_.sin2 * ft, turned_.sin2 * (fa - fb) + turned_.cos2 * ft;
  return slope * d.per_length[k];
}

Matrix5 BlurredContour::axes_slope() const {
  const double half = std::max(0.5 * (ellipse_.a_px - ellipse_.b_px), 1e-6);
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = change(1, 1) = 1.0;
  change.row(2) << 0.0, 0.0, 1.0, turned_.cos2, turned_.sin2;
  change.row(3) << 0.0, 0.0, 1.0, -turned_.cos2, -turned_.sin2;
  change.row(4) << 0.0, 0.0, 0.0, -turned_.sin2 / (2.0 * half), turned_.cos2 / (2.0 * half);
  return change;
}

std::optional<Ellipse> moved_by(const Ellipse& e, const Turned& turned, const Vector5& step) {
  const double mean = 0.5 * (e.a_px + e.b_px) + step[2], half = 0.5 * (e.a_px - e.b_px);
  const double e1 = half * turned.cos2 + step[3], e2 = half * turned.sin2 + step[4];
  const double difference = std::hypot(e1, e2);
  if (!(difference < mean)) return std::nullopt;
  return normalised(
      {e.cx_px + step[0], e.cy_px + step[1], mean + difference, mean - difference, 0.5 * std::atan2(e2, e1)});
}

void limit_direction(Matrix5& covariance) {
  if (covariance(4, 4) <= kThetaVariance) return;
  covariance.row(4).setZero();
  covariance.col(4).setZero();
  covariance(4, 4) = kThetaVariance;
}

}  // namespace pharos::ellipse
