// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pharos::ellipse {
namespace {

// In the ellipse's own axes.
PointPx local(const Ellipse& e, PointPx p) {
  const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
  const double u = p.u - e.cx_px, v = p.v - e.cy_px;
  return {c * u + s * v, c * v - s * u};
}

}  // namespace

double perimeter_px(const Ellipse& e) {
  return std::numbers::pi * (1.5 * (e.a_px + e.b_px) - std::sqrt(e.a_px * e.b_px));
}

PointPx point_at(const Ellipse& e, double t_rad) {
  const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
  const double x = e.a_px * std::cos(t_rad), y = e.b_px * std::sin(t_rad);
  return {e.cx_px + c * x - s * y, e.cy_px + s * x + c * y};
}

double anomaly_of(const Ellipse& e, PointPx point) {
  const PointPx p = local(e, point);
  return std::atan2(p.v * e.a_px, p.u * e.b_px);
}

EllipseDistance::EllipseDistance(const Ellipse& e)
    : ellipse_(e), cos_(std::cos(e.theta_rad)), sin_(std::sin(e.theta_rad)) {}

double EllipseDistance::px(PointPx point) const {
  const double a = ellipse_.a_px, b = ellipse_.b_px;
  const double u = point.u - ellipse_.cx_px, v = point.v - ellipse_.cy_px;
  const double x = (cos_ * u + sin_ * v) / a, y = (cos_ * v - sin_ * u) / b;
  const double f = x * x + y * y - 1.0;
  const double slope = 2.0 * std::hypot(x / a, y / b);
  // At the centre there is no slope: the contour is b away.
  return slope * b > 1e-9 ? std::max(f / slope, -b) : -b;
}

double EllipseDistance::squared_px2(PointPx point) const {
  const double per_a = 1.0 / ellipse_.a_px, per_b = 1.0 / ellipse_.b_px;
  const double u = point.u - ellipse_.cx_px, v = point.v - ellipse_.cy_px;
  const double x = (cos_ * u + sin_ * v) * per_a, y = (cos_ * v - sin_ * u) * per_b;
  const double f = x * x + y * y - 1.0, squared_b = ellipse_.b_px * ellipse_.b_px;
  const double squared_slope = 4.0 * (x * x * per_a * per_a + y * y * per_b * per_b);
  const bool is_central = f < 0.0 && f * f >= squared_b * squared_slope;
  return is_central ? squared_b : f * f / squared_slope;
}

double EllipseDistance::far_px(PointPx point) const {
  const double a = ellipse_.a_px, b = ellipse_.b_px;
  const double u = point.u - ellipse_.cx_px, v = point.v - ellipse_.cy_px;
  const double x = std::abs(cos_ * u + sin_ * v), y = std::abs(cos_ * v - sin_ * u);
  // The foot (a p, b q) in the first quadrant: the circle of curvature there meets the line from its centre to the
  // point in the next foot.
  constexpr int kSteps = 3;
  const double evolute = a * a - b * b, per_a = 1.0 / a, per_b = 1.0 / b;
  const auto length = [](double p, double q) { return std::sqrt(p * p + q * q); };
  double p = x * per_a, q = y * per_b;
  const double size = length(p, q);
  if (!(size > 1e-9)) return -b;
  p /= size;
  q /= size;
  for (int k = 0; k < kSteps; ++k) {
    const double centre_x = evolute * p * p * p * per_a, centre_y = -evolute * q * q * q * per_b;
    const double radius = length(a * p - centre_x, b * q - centre_y);
    const double ratio = radius / std::max(length(x - centre_x, y - centre_y), 1e-9);
    p = std::max(0.0, ((x - centre_x) * ratio + centre_x) * per_a);
    q = std::max(1e-12, ((y - centre_y) * ratio + centre_y) * per_b);
    const double per_length = 1.0 / length(p, q);
    p *= per_length;
    q *= per_length;
  }
  const double distance = length(x - a * p, y - b * q);
  return size < 1.0 ? -distance : distance;
}

double distance_px(const Ellipse& e, PointPx point) { return EllipseDistance(e).px(point); }

Ellipse normalised(Ellipse e) {
  if (e.a_px < e.b_px) {
    std::swap(e.a_px, e.b_px);
    e.theta_rad += std::numbers::pi / 2.0;
  }
  e.theta_rad = std::remainder(e.theta_rad, std::numbers::pi);
  if (e.theta_rad <= -std::numbers::pi / 2.0) e.theta_rad += std::numbers::pi;
  return e;
}

}  // namespace pharos::ellipse
