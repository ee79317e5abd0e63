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

double distance_px(const Ellipse& e, PointPx point) {
  const PointPx p = local(e, point);
  const double x = p.u / e.a_px, y = p.v / e.b_px;
  const double f = x * x + y * y - 1.0;
  const double slope = 2.0 * std::hypot(x / e.a_px, y / e.b_px);
  // At the centre nothing has a slope: the contour is b away.
  return slope * e.b_px > 1e-9 ? std::max(f / slope, -e.b_px) : -e.b_px;
}

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
