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

double EllipseDistance::far_px(PointPx point) const {
  const double a = ellipse_.a_px, b = ellipse_.b_px;
  const double u = point.u - ellipse_.cx_px, v = point.v - ellipse_.cy_px;
  const double x = (cos_ * u + sin_ * v) / a, y = (cos_ * v - sin_ * u) / b;
  const double size = std::hypot(x, y), slope = std::hypot(x / a, y / b);
  return slope * b > 1e-9 ? size * (size - 1.0) / slope : -b;
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
