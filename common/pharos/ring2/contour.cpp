// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::ring2 {
namespace {

// Points along the contour for the mean over it: smooth and periodic, so few are exact.
constexpr int kPlaces = 32;
// The variance of an unknown direction: the detector assigns it to circles.
constexpr double kAnyDirection_rad2 = std::numbers::pi * std::numbers::pi / 12.0;

Contour bare(const ellipse::Ellipse& e) {
  const double c = std::cos(e.theta_rad);
  const double s = std::sin(e.theta_rad);
  Contour contour;
  contour.ellipse = e;
  contour.centre_px = {e.cx_px, e.cy_px};
  const double aa = e.a_px * e.a_px;
  const double bb = e.b_px * e.b_px;
  contour.shape_px2 << aa * c * c + bb * s * s, (aa - bb) * c * s, (aa - bb) * c * s, aa * s * s + bb * c * c;
  contour.inverse_shape << c * c / aa + s * s / bb, c * s / aa - c * s / bb, c * s / aa - c * s / bb,
      s * s / aa + c * c / bb;
  return contour;
}

// Mean of slope slope^T along the contour.
Matrix5 mean_information(const Contour& contour, const ellipse::Ellipse& e) {
  Matrix5 sum = Matrix5::Zero();
  double length = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double t = 2.0 * std::numbers::pi * k / kPlaces;
    const ellipse::PointPx point = ellipse::point_at(e, t);
    const double weight = std::hypot(e.a_px * std::sin(t), e.b_px * std::cos(t));
    add_outer<5>(sum, contour.offset_of({point.u, point.v}).slope, weight);
    length += weight;
  }
  return sum / length;
}

// From (cx, cy, a, b, theta) to (cx, cy, Sxx, Sxy, Syy).
Matrix5 shape_covariance(const ellipse::DetectedEllipse& detected) {
  const ellipse::Ellipse& e = detected.ellipse;
  const double c = std::cos(e.theta_rad);
  const double s = std::sin(e.theta_rad);
  const Vector5 by_a(0.0, 0.0, 2.0 * e.a_px * c * c, 2.0 * e.a_px * c * s, 2.0 * e.a_px * s * s);
  const Vector5 by_b(0.0, 0.0, 2.0 * e.b_px * s * s, -2.0 * e.b_px * c * s, 2.0 * e.b_px * c * c);
  const Vector5 turn(0.0, 0.0, -2.0 * c * s, c * c - s * s, 2.0 * c * s);
  const double turned = e.a_px * e.a_px - e.b_px * e.b_px;
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = change(1, 1) = 1.0;
  change.col(2) = by_a;
  change.col(3) = by_b;
  change.col(4) = turned * turn;
  Matrix5 out = (change * detected.covariance).eval() * change.transpose();
  if (detected.covariance(4, 4) < 0.99 * kAnyDirection_rad2) return out;
  // A circle: across its arbitrary long axis its shape is known as well as along it.
  const double half = 0.25 * (detected.covariance(2, 2) + detected.covariance(3, 3) - 2.0 * detected.covariance(2, 3));
  const double mean = e.a_px + e.b_px;
  add_outer<5>(out, turn, std::max(0.0, mean * mean * half - turned * turned * kAnyDirection_rad2));
  return out;
}

}  // namespace

Contour::Offset Contour::offset_of(const Vector2& point_px) const {
  const Vector2 from_centre = point_px - centre_px;
  const Vector2 u = (inverse_shape * from_centre).normalized();
  const double reach = std::sqrt(u.dot(shape_px2 * u));
  const double per_reach = 0.5 / reach;
  Offset offset;
  offset.normal = u;
  offset.distance_px = u.dot(from_centre) - reach;
  offset.slope << u.x(), u.y(), u.x() * u.x() * per_reach, 2.0 * u.x() * u.y() * per_reach, u.y() * u.y() * per_reach;
  return offset;
}

Contour contour_of(const ellipse::Ellipse& e, double sigma_px, double points) {
  Contour contour = bare(e);
  contour.sigma_px = sigma_px;
  contour.information = points / (sigma_px * sigma_px) * mean_information(contour, e);
  return contour;
}

Contour contour_of(const ellipse::DetectedEllipse& detected, double systematic_px) {
  Contour contour = bare(detected.ellipse);
  contour.sigma_px = detected.rms_px;
  const auto fixed = positive_inverse<5>(mean_information(contour, detected.ellipse));
  Matrix5 covariance = shape_covariance(detected);
  if (fixed) covariance += systematic_px * systematic_px * *fixed;
  const auto information = positive_inverse<5>(covariance);
  if (information) contour.information = *information;
  return contour;
}

bool is_usable(const ellipse::Ellipse& e) {
  return std::isfinite(e.cx_px) && std::isfinite(e.cy_px) && std::isfinite(e.a_px) && std::isfinite(e.b_px) &&
         std::isfinite(e.theta_rad) && e.a_px > 0.0 && e.b_px > 0.0;
}

}  // namespace pharos::ring2
